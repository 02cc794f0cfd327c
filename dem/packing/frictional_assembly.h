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
   * The same to the last bit for any number of threads.
   */
  class FrictionalAssembly
  {
  public:
    /** @param start equal spheres of radius 1 in a periodic cell, at rest */
    FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &parameters);

    /** Before the first step: give a sphere a velocity [radius/sqrt(mass/k_n)] and a spin [1/sqrt(mass/k_n)]. */
    void            set_motion(std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    Eigen::Vector3d spin(std::size_t sphere) const; ///< half a step before now [1/sqrt(mass/k_n)]

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
    double pushed_by_plates() const; ///< sum of force times distance
    double volume() const;
    double block_forces(std::size_t block); ///< @return sum of force times distance
    void   move(double strain);
    double block_motion(std::size_t block, double growth); ///< @return square of the largest displacement

    FrictionalAssemblyParameters material;
    std::size_t                  spheres;
    std::vector<std::int32_t>    order, rank; ///< spheres lie along a curve that fills space: neighbours near in memory
    Cell                         cell;
    base::Column                 pose;     ///< records: centre (3), turn of the last step (3), - -
    base::Column                 velocity; ///< records: of the centre (3), spin (3), - -
    SpherePairs                  pairs;
    base::Column force; ///< records of lines: on the first sphere (3), couple on either about its centre (3), - -
    double       pressure = 0;
  };
} // namespace dem
