#pragma once

#include "dem/model/packing.h"
#include "dem/specimen/specimen.h"

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
    double time_step;   ///< in sqrt(mass/k_n); shorter where the contacts' stiffness demands it
  };

  /** What the compaction steers by. */
  struct AssemblyMeasures
  {
    double pressure;         ///< -trace(stress)/3, Love-Weber, in k_n/radius
    double unbalanced_ratio; ///< mean |sum of forces on a particle| / mean |contact force|; infinite without contact
    std::int64_t contacts;
  };

  /**
   * Equal spheres in a rectangular periodic cell, pushing at each other by linear contacts with Coulomb friction (LinearContactLaw),
   * advanced as a Specimen is, with local damping, while the cell shrinks or grows alike in all directions.
   *
   * Everything is in the units radius = 1, normal stiffness k_n = 1, mass of a sphere = 1: such a packing depends on no other
   * scale.
   */
  class FrictionalAssembly
  {
  public:
    /** @param start equal spheres of radius 1 in a periodic cell, at rest */
    FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &parameters);

    /** Before the first step: give a sphere a velocity [radius/sqrt(mass/k_n)] and a spin [1/sqrt(mass/k_n)]. */
    void            set_motion(std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    Eigen::Vector3d spin(std::size_t sphere) const; ///< half a step before now [1/sqrt(mass/k_n)]

    /** Steps, in each of which every length of the cell grows by the factor 1 + strain(pressure at the last step). */
    void advance(std::int64_t steps, const std::function<double(double)> &strain);

    // All that follows where the forces of the last step were found, before its motion.
    Eigen::Vector3d  edges() const;
    AssemblyMeasures measures() const;
    double           mean_overlap() const; ///< of the contacts, in radii
    /** Centres brought into the cell. */
    std::vector<Eigen::Vector3d> centres() const;

  private:
    Specimen    specimen;
    std::size_t spheres;
  };
} // namespace dem
