#pragma once

#include "coupling/volume/multipliers.h"
#include "dem/measures/fine_scale.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace coupling
{
  /** How the absorber separates motion that a mesh can carry from motion that it cannot, and how it is integrated in time. */
  struct AbsorberParameters
  {
    double spacing   = 0;   ///< H of the grid of averages [m], > 0
    int    sharpness = 3;   ///< p: how often the average is taken off, >= 1
    double phase     = 1.9; ///< longest time damped at once, times the largest rate: > 0, below 2
  };

  /** Members of an average: particles, and points of the solid where there are no particles any more. */
  struct AbsorberCarriers
  {
    int                          dimension = 3;
    dem::SplineGrid::Components  components;        ///< of velocities that can be other than zero
    std::vector<Eigen::Vector3d> places;            ///< of the particles [m]
    Eigen::VectorXd              whole_mass;        ///< of the particles, as if they did not share [kg]
    Eigen::VectorXd              damping;           ///< of the particles: rate times mass [kg/s]
    CarrierRows                  inverse_mass;      ///< of the particles, zero where motion is prescribed [1/kg]
    std::vector<Eigen::Vector3d> points;            ///< of the solid [m]
    Eigen::VectorXd              point_mass;        ///< [kg]
    WeightRows                   weights;           ///< of the nodes (columns) at the points
    CarrierRows                  inverse_node_mass; ///< likewise [1/kg]
  };

  /**
   * Damps what a mesh cannot carry and would throw back (doc/theory/volume-coupling.md, 4): m dv/dt = -F^T C F v with F = (1 - G)^p (1 -
   * Pi), G the average over a grid of cubic B-splines, which is no projection and mirrors nothing, Pi the fit of rigid motion and even
   * strain. It only ever takes energy, whatever the arrangement of the particles.
   */
  class FineScaleAbsorber
  {
  public:
    /** @throws base::InputError for a spacing, sharpness or phase that is none */
    FineScaleAbsorber(const AbsorberParameters &parameters, AbsorberCarriers carriers);

    /** What damping over a time [s] changes of velocities [m/s]. */
    CarrierChanges changes(const CarrierRows &particles, const CarrierRows &nodes, double time) const;

    /** Longest time that may be damped in one go [s]. */
    double longest_time() const { return fastest > 0 ? own.phase / fastest : std::numeric_limits<double>::infinity(); }

  private:
    static constexpr std::size_t record = dem::SplineGrid::record;

    void           find_largest_rate();
    CarrierChanges in_steps(const CarrierRows &particles, const CarrierRows &nodes, double time, int steps) const;
    void           enter(const CarrierRows &particles) const;
    /** What velocities that were entered have become since is added to these. */
    void add_entered(CarrierRows &particles) const;
    /** Velocities that were entered and those of the nodes, less so many times force over mass. */
    void                                 step(double time, CarrierRows &nodes) const;
    Eigen::Map<const Eigen::RowVector3d> row(const base::Column &column, const std::size_t carrier) const
    {
      return Eigen::Map<const Eigen::RowVector3d>(&column[row_of[carrier]]);
    }

    AbsorberParameters       own;
    AbsorberCarriers         carriers;
    WeightRows               points_of_nodes; ///< transpose of the weights
    dem::FineScaleFilter     filter;
    std::vector<std::size_t> row_of;              ///< of each carrier in the filter's order
    base::Column             inverse_mass;        ///< of the carriers in that order; of points none, whose nodes move
    double                   fastest = 0;         ///< not below the largest eigenvalue of the damping [1/s]
    mutable base::Column     velocity, force;     ///< of all carriers, during a call
    mutable CarrierRows      at_points, on_nodes; ///< likewise
  };
} // namespace coupling
