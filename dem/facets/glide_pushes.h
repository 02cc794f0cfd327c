#pragma once

#include "base/column.h"
#include "dem/facets/surface_contacts.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace dem
{
  /** Columns of velocities or displacements on the way of a particle through its step: 3 of the place, 3 of rotation, 2 unused. */
  struct GlideRates
  {
    const base::Column *before,
      *after;                       ///< velocities in the halves of the step before and after the forces [m/s], [rad/s]
    double half_before, half_after; ///< lengths of these halves [s]
  };

  /**
   * What surfaces give to particles that glide through several of their steps (doc/theory/surface-coupling.md, 2): the impulse of each
   * on each, its moment about where the particle was when it began to glide, and the work that the contacts have done on the way.
   * In the order of surfaces and particles: same bits for any number of threads.
   */
  class GlidePushes
  {
  public:
    /** Contacts push for a time [s] where particles have glided on for another. */
    void add_impulses(const SurfaceContacts &surfaces, double kick, double glided, const base::Column &velocity);
    /** Contacts work with the forces that they have now over half of a motion of the particles. */
    void add_work(const SurfaceContacts &surfaces, const base::Column &motion);
    /** The same on the way to where they began to glide. */
    void add_work_before(const SurfaceContacts &surfaces, const base::Column &motion);

    bool empty() const { return pushes.empty(); }
    /** Records of the mean force and moment on each particle. @param kick time that the particles' step takes them for [s] */
    base::Column mean(std::size_t particles, double kick) const;

    /**
     * What particles, which take all impulses at once, have got more than the contacts have worked: made by sub-cycling, entered in the
     * work of each surface. @return its sums in the halves of the step before and after the forces [J]
     */
    std::array<double, 2> enter_difference(SurfaceContacts &surfaces, const GlideRates &rates) const;

  private:
    struct Push
    {
      Eigen::Vector3d       impulse = Eigen::Vector3d::Zero(); ///< [N s]
      Eigen::Vector3d       turn    = Eigen::Vector3d::Zero(); ///< [N m s]
      std::array<double, 2> work    = {0, 0};                  ///< before and after [J]
    };

    void enter_work(const SurfaceContacts &surfaces, const base::Column &motion, std::size_t half);

    std::map<std::pair<std::int32_t, std::int32_t>, Push> pushes; ///< of surface and particle
  };
} // namespace dem
