#pragma once

#include "dem/measures/spline_grid.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /**
   * What of velocities is too fine for a mesh, and the force that damps it (doc/theory/volume-coupling.md, 4): F^T m C F v with F = (1 -
   * G)^p (1 - Pi), G the average over a grid of cubic B-splines, Pi the fit of what varies evenly with the place.
   *
   * Values are records of SplineGrid, in the order of the filter.
   */
  class FineScaleFilter
  {
  public:
    /** Members of the averages. */
    struct Carriers
    {
      std::vector<Eigen::Vector3d> places; ///< [m]
      std::vector<double>          masses; ///< [kg], > 0
      std::vector<double>          rates;  ///< at which they are damped, times their share of the mass: C [1/s]
    };

    FineScaleFilter() = default;
    /**
     * @param spacing of the grid [m], > 0 @param dimension 2: all of it lies in the plane z = 0 @param sharpness p, >= 1
     * @param components of velocities that can be other than zero: the others are ignored
     */
    FineScaleFilter(const Carriers               &carriers,
                    double                        spacing,
                    int                           dimension,
                    int                           sharpness,
                    const SplineGrid::Components &components = {});

    /** Which of the given carriers each of the filter's is. */
    const std::vector<std::size_t> &order() const { return grid.order(); }

    /** @param velocities [m/s] @param force over it; may not be the same column [N] */
    void damping(const base::Column &velocities, base::Column &force) const;

  private:
    using Columns =
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Eigen::Dynamic, 3>, Eigen::Aligned64>;

    Columns on_knots(base::Column &field) const
    {
      return {field.data(), inverse_mass.size(), static_cast<Eigen::Index>(grid.components().count)};
    }
    /** Sum of (1 - K)^j, j < p, of a field on the knots: K averages what places between them have, as G does at the places. */
    void accumulate(base::Column &field) const;
    void accumulate_transposed(base::Column &field) const;

    int                  sharpness = 1;
    SplineGrid           grid;
    base::Column         masses, rates;                            ///< of the carriers, in the grid's order
    Eigen::VectorXd      knot_mass, inverse_mass, inverse_average; ///< of the knots [kg]; 1/kg; of its averages [1/kg]
    Eigen::MatrixXd      affine;  ///< fields that vary evenly, on the knots: splines of these are the same at places
    Eigen::MatrixXd      weighed; ///< the same of places, times their masses, spread
    Eigen::MatrixXd      inverse_moments;
    mutable base::Column summed, term, smoothed; ///< on the knots, during a call
  };
} // namespace dem
