#pragma once

#include "base/column.h"
#include "dem/model/cell.h"
#include "dem/model/packing.h"
#include "dem/packing/sphere_pairs.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  /** Material of an assembly, in the units of FrictionalAssembly. */
  struct FrictionalAssemblyParameters
  {
    double friction;    ///< coefficient mu = tan phi [-], >= 0
    double shear_ratio; ///< k_s/k_n [-], >= 0
    double damping;     ///< local (Cundall) damping D [-], in [0, 1)
    double time_step;   ///< in sqrt(mass/k_n); stability is the caller's (doc/theory/packing.md, 1)
    bool   plates =
      false; ///< six smooth plates in place of periodicity, through the origin and `beyond_plates` short of the far edges
  };

  /** Periodic images beyond a plate are this much farther away than the plate [radius]: they never touch. */
  constexpr double beyond_plates = 1;

  /** What the compaction steers by. */
  struct AssemblyMeasures
  {
    double pressure;         ///< -trace(stress)/3, Love-Weber, in k_n/radius
    double unbalanced_ratio; ///< mean |sum of forces on a particle| / mean |contact force|; infinite without contact
    std::int64_t contacts;
  };

  /**
   * Equal spheres in a rectangular periodic cell, or between six smooth plates with the stiffness k_n, pushing at each other by
   * linear contacts with Coulomb friction (dem/laws/linear_contact.h), advanced by leap-frog steps with local damping, while the
   * cell shrinks or grows alike in all directions.
   *
   * Everything is in the units radius = 1, normal stiffness k_n = 1, mass of a sphere = 1: such a packing depends on no other
   * scale. A specimen does the same for bodies of all kinds; here are equal spheres only, shear follows the contact to
   * first order in the step, and nothing is accounted for, which makes a step a third of the work
   * (doc/theory/packing.md, 1).
   *
   * The same to the last bit for any number of threads, and of ranks: each has spheres and pairs of its own (SphereShare), all make the same calls.
   */
  class FrictionalAssembly
  {
  public:
    /** @param start equal spheres of radius 1 in a periodic cell, at rest @param ranks null: this process alone; otherwise they outlive this object */
    FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &parameters, Ranks *ranks = nullptr);
    FrictionalAssembly(const FrictionalAssembly &)            = delete; // pairs know the share
    FrictionalAssembly &operator=(const FrictionalAssembly &) = delete;

    /** Before the first step, alone: give a sphere a velocity [radius/sqrt(mass/k_n)] and a spin [1/sqrt(mass/k_n)]. */
    void            set_motion(std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    Eigen::Vector3d spin(std::size_t sphere) const; ///< alone: half a step before now [1/sqrt(mass/k_n)]

    /** Steps, in each of which every length of the cell grows by the factor 1 + strain(pressure at its start). */
    void advance(std::int64_t steps, const std::function<double(double)> &strain);

    Eigen::Vector3d  edges() const; ///< of the cell, or between the plates
    AssemblyMeasures measures() const;
    double           mean_overlap() const; ///< of the contacts, in radii
    /** Centres, of a periodic cell brought into it. */
    std::vector<Eigen::Vector3d> centres() const;

  private:
    struct Plates;

    void   find_forces();
    double pushed_by_pairs();        ///< sum of force times distance
    double pushed_by_plates() const; ///< the same
    double volume() const;
    /** Forces of some lines. @param note called with the line, the forces and the distances of a pack @return minus the sum of their products, in lanes */
    template <typename Note>
    Pack lines_forces(std::size_t begin, std::size_t end, const Note &note);
    /** What each own sphere is pushed by others. @param numbers added up: forces, and how many */
    std::vector<Eigen::Vector3d> unbalanced_forces(double &pushing, double &contacts) const;
    void                         move(double strain);
    double block_motion(std::size_t block, double growth); ///< @return square of the largest displacement

    FrictionalAssemblyParameters material;
    SphereShare                  share;
    std::vector<std::int32_t>    order, rank; ///< spheres lie along a curve that fills space: neighbours near in memory
    Cell                         cell;
    base::Column                 pose;     ///< records: centre (3), turn of the last step (3), - -
    base::Column                 velocity; ///< records: of the centre (3), spin (3), - -
    SpherePairs                  pairs;
    base::Column force; ///< records of lines: on the first sphere (3), couple on either about its centre (3), - -
    double       pressure = 0;
  };
} // namespace dem
