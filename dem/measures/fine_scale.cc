#include "dem/measures/fine_scale.h"

#include <Eigen/QR>

namespace dem
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    VectorXd inverse_of(const VectorXd &masses)
    {
      return masses.unaryExpr([](const double m) { return m > 0 ? 1 / m : 0.0; });
    }
  } // namespace

  FineScaleFilter::FineScaleFilter(const Carriers               &carriers,
                                   const double                  spacing,
                                   const int                     dimension,
                                   const int                     sharpness_,
                                   const SplineGrid::Components &components)
    : sharpness(sharpness_)
    , grid(carriers.places, spacing, dimension, components)
  {
    const std::size_t count  = carriers.places.size();
    Vector3d          centre = Vector3d::Zero();
    double            all    = 0;
    for (const std::size_t k : grid.order())
      {
        masses.push_back(carriers.masses[k]);
        rates.push_back(carriers.rates[k]);
        centre += carriers.masses[k] * carriers.places[k];
        all += carriers.masses[k];
      }
    centre /= all;

    const auto   knots = static_cast<Index>(grid.knots());
    base::Column values(SplineGrid::record * count), field;
    for (std::size_t k = 0; k < count; ++k)
      values[SplineGrid::record * k + components.first] = 1;
    grid.spread(values, masses, field);
    knot_mass    = Eigen::Map<VectorXd>(field.data(), knots);
    inverse_mass = inverse_of(knot_mass);
    field.resize(grid.knots());
    grid.smooth(field);
    inverse_average = inverse_of(Eigen::Map<VectorXd>(field.data(), knots));

    affine.resize(knots, dimension + 1);
    weighed.resize(knots, dimension + 1);
    affine.col(0).setOnes();
    weighed.col(0) = knot_mass;
    for (Index n = 0; n < knots; ++n)
      affine.row(n).tail(dimension) =
        (grid.place_of_knot(static_cast<std::size_t>(n)) - centre).head(dimension).transpose();
    MatrixXd places(count, dimension + 1);
    places.col(0).setOnes();
    for (int d = 0; d < dimension; ++d) // one after the other: the grid may have a single column
      {
        for (std::size_t k = 0; k < count; ++k)
          places(static_cast<Index>(k), d + 1) = values[SplineGrid::record * k + components.first] =
            carriers.places[grid.order()[k]][d] - centre[d];
        grid.spread(values, masses, field);
        weighed.col(d + 1) = on_knots(field).col(0);
      }
    const MatrixXd moments =
      places.transpose() * Eigen::Map<VectorXd>(masses.data(), static_cast<Index>(count)).asDiagonal() * places;
    // What all carriers have in common along an axis (a row of them) says nothing there.
    inverse_moments = moments.completeOrthogonalDecomposition().pseudoInverse();
  }

  void FineScaleFilter::accumulate(base::Column &field) const
  {
    term = field;
    for (int j = 1; j < sharpness; ++j)
      {
        smoothed.resize(term.size());
        on_knots(smoothed) = knot_mass.asDiagonal() * on_knots(term);
        grid.smooth(smoothed);
        on_knots(term) -= inverse_average.asDiagonal() * on_knots(smoothed);
        on_knots(field) += on_knots(term);
      }
  }

  void FineScaleFilter::accumulate_transposed(base::Column &field) const
  {
    term = field;
    for (int j = 1; j < sharpness; ++j)
      {
        smoothed.resize(term.size());
        on_knots(smoothed) = inverse_average.asDiagonal() * on_knots(term);
        grid.smooth(smoothed);
        on_knots(term) -= knot_mass.asDiagonal() * on_knots(smoothed);
        on_knots(field) += on_knots(term);
      }
  }

  void FineScaleFilter::damping(const base::Column &velocities, base::Column &force) const
  {
    // F v: what averages take off is a field on the knots, so all but the first and the last pass are over these.
    grid.spread(velocities, masses, summed);
    MatrixXd even = inverse_moments * (affine.transpose() * on_knots(summed));
    on_knots(summed) -= weighed * even;
    on_knots(summed).array().colwise() *= inverse_mass.array();
    accumulate(summed);
    on_knots(summed) += affine * even;
    grid.take_off(summed, velocities, rates, force);
    // The transpose of the same.
    grid.spread(force, masses, summed);
    even = affine.transpose() * on_knots(summed);
    accumulate_transposed(summed);
    on_knots(summed).array().colwise() *= inverse_mass.array();
    even -= weighed.transpose() * on_knots(summed);
    on_knots(summed) += affine * (inverse_moments * even);
    grid.take_off(summed, force, masses, force);
  }
} // namespace dem
