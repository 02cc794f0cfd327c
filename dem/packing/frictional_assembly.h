#pragma once

#include "dem/core/column.h"
#include "dem/model/packing.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Material of an assembly, in the units of FrictionalAssembly. */
  struct FrictionalAssemblyParameters
  {
    double friction;    ///< coefficient mu = tan phi [-], >= 0
    double shear_ratio; ///< k_s/k_n [-], >= 0
    double damping;     ///< local (Cundall) damping D [-], in [0, 1)
    double time_step;   ///< in sqrt(mass/k_n)
  };

  /** What the compaction steers by. */
  struct AssemblyMeasures
  {
    double pressure;         ///< -trace(stress)/3, Love-Weber, in k_n/radius
    double unbalanced_ratio; ///< mean |sum of forces on a particle| / mean |contact force|; infinite without contact
    double mean_overlap;     ///< of the contacts, in radii
    std::int64_t contacts;
  };

  /**
   * Equal spheres in a rectangular periodic cell, pushing at each other by linear springs with Coulomb friction (Cundall and Strack,
   * 1979), advanced by leap-frog steps with local damping while the cell shrinks or grows alike in all directions.
   *
   * Everything is in the units radius = 1, normal stiffness k_n = 1, mass of a sphere = 1: such a packing depends on no other
   * scale. Velocities are kept as the fluctuation about the homogeneous motion of the cell (doc/theory/periodic-cell.md).
   * The incremental tangential force turns with the contact exactly (doc/theory/shear-kinematics.md, 1).
   */
  class FrictionalAssembly
  {
  public:
    /** @param start equal spheres of radius 1 in a periodic cell, at rest */
    FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &parameters);

    /** Give a sphere a velocity [radius/sqrt(mass/k_n)] and a spin [1/sqrt(mass/k_n)], half a step before now. */
    void            set_motion(std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin);
    Eigen::Vector3d spin(std::size_t sphere) const; ///< half a step before now [1/sqrt(mass/k_n)]

    /** One step, in which every length of the cell grows by the factor 1 + strain. */
    void step(double strain);

    Eigen::Vector3d  edges() const { return cell_edges; }
    double           pressure() const;
    AssemblyMeasures measures() const;
    /** Centres brought into the cell. */
    std::vector<Eigen::Vector3d> centres() const;

  private:
    void move(double strain);
    void find_candidates();
    void update_forces();
    bool candidates_are_complete() const;

    FrictionalAssemblyParameters parameters;
    std::size_t                  particles;
    Eigen::Vector3d              cell_edges;

    // Records of eight doubles (see dem/core/records.h), one per particle.
    Column place;  ///< centre, rotation vector of the last step, its Hughes-Winget factor, 0
    Column motion; ///< fluctuation displacement of the last step, rotation vector of the last step, 0, 0
    Column force;  ///< force, moment, 0, 0

    // Pairs that may touch before the next search, in the order of find_pairs, filled up to a multiple of the pack.
    std::size_t               candidates = 0; ///< without the filling
    std::vector<std::int32_t> first, second;
    Column                    shift[3];  ///< periodic image of the second, in cells
    Column                    branch[3]; ///< at the last step
    Column                    slip[3];   ///< elastic tangential displacement, 0 unless touching

    Column searched_at;         ///< centres at the last search, x, y, z of each particle
    double searched_edge   = 0; ///< the first of the cell's edges then: all have kept their proportions
    double largest_drift_2 = 0; ///< of any particle since the search, squared, in units of the cell at the search

    double       overlap_times_length = 0; ///< sum over contacts
    double       overlap_sum = 0, force_sum = 0;
    std::int64_t contact_count = 0;
  };
} // namespace dem
