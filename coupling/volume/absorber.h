#pragma once

#include "coupling/volume/multipliers.h"
#include "dem/measures/spline_grid.h"

#include <Eigen/Core>

#include <vector>

namespace coupling
{
  /** How the absorber tells what a mesh can carry from what it cannot. */
  struct AbsorberParameters
  {
    double spacing   = 0; ///< H of the grid of averages [m], > 0
    int    sharpness = 3; ///< p: how often the average is taken off, >= 1
  };

  /** Who takes part in an average: particles, and points of the solid where there are no particles any more. */
  struct AbsorberCarriers
  {
    int                          dimension = 3;
    std::vector<Eigen::Vector3d> places;            ///< of the particles [m]
    Eigen::VectorXd              whole_mass;        ///< of the particles, as if they shared with nobody [kg]
    Eigen::VectorXd              damping;           ///< of the particles: rate times mass [kg/s]
    CarrierRows                  inverse_mass;      ///< of the particles, zero where motion is prescribed [1/kg]
    std::vector<Eigen::Vector3d> points;            ///< of the solid [m]
    Eigen::VectorXd              point_mass;        ///< [kg]
    WeightRows                   weights;           ///< of the nodes (columns) at the points
    CarrierRows                  inverse_node_mass; ///< likewise [1/kg]
  };

  /**
   * Damps what a mesh cannot carry and would throw back (doc/theory/volume-coupling.md, 4): m dv/dt = -F^T C F v with F = (1 - G)^p, G
   * the average over a grid of cubic B-splines, which is no projection and mirrors nothing. It only ever takes energy, whatever the
   * arrangement of the particles.
   */
  class FineScaleAbsorber
  {
  public:
    /** @throws base::InputError for a spacing or sharpness that is none */
    FineScaleAbsorber(const AbsorberParameters &parameters, AbsorberCarriers carriers);

    /** What damping over a time [s] changes of velocities [m/s]. */
    CarrierChanges changes(const CarrierRows &particles, const CarrierRows &nodes, double time) const;

    double largest_rate() const { return fastest; } ///< largest eigenvalue of the damping [1/s]

  private:
    static constexpr std::size_t record = dem::SplineGrid::record;

    /** So that the motion of a rigid body, and even strain, are not damped: nor where averages are one-sided, at free faces. */
    void make_fit();
    void find_largest_rate();
    /** What is too fine of velocities of all carriers, which become that. */
    void take_off_averages(base::Column &all) const;
    /** The transpose. */
    void take_off_averages_transposed(base::Column &all) const;
    /** Damping force over velocities of particles and nodes [N]. */
    CarrierChanges forces(const CarrierRows &particles, const CarrierRows &nodes) const;

    const Eigen::Vector3d &place(const std::size_t carrier) const
    {
      const std::size_t of_particles = carriers.places.size();
      return carrier < of_particles ? carriers.places[carrier] : carriers.points[carrier - of_particles];
    }
    std::size_t size() const { return carriers.places.size() + carriers.points.size(); }

    int                  sharpness;
    AbsorberCarriers     carriers;
    WeightRows           points_of_nodes; ///< transpose of the weights
    dem::SplineGrid      grid;
    Eigen::VectorXd      mass, inverse_grid_mass; ///< of carriers, of knots
    Eigen::MatrixXd      affine, fit; ///< fields that vary evenly with the place; what of them velocities have
    double               fastest = 0;
    mutable base::Column on_grid, averaged, of_all; ///< during a call
  };
} // namespace coupling
