#include "coupling/volume/absorber.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    using Records = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>, Eigen::Aligned64>;

    Records records(base::Column &column) { return {column.data(), static_cast<Index>(column.size() / 4), 4}; }
  } // namespace

  FineScaleAbsorber::FineScaleAbsorber(const AbsorberParameters &parameters, AbsorberCarriers given)
    : sharpness(parameters.sharpness)
    , carriers(std::move(given))
    , points_of_nodes(carriers.weights.transpose())
  {
    if (!(parameters.spacing > 0))
      throw base::InputError("Absorber: the spacing of its grid must be above 0 m.");
    if (sharpness < 1)
      throw base::InputError("Absorber: the sharpness must be 1 at least.");
    mass.resize(static_cast<Index>(size()));
    mass << carriers.whole_mass, carriers.point_mass;
    std::vector<Vector3d> all;
    for (std::size_t k = 0; k < size(); ++k)
      all.push_back(place(k));
    grid = dem::SplineGrid(all, parameters.spacing, carriers.dimension);
    base::Column masses(record * size());
    records(masses).colwise() = mass;
    grid.spread(masses, on_grid);
    inverse_grid_mass = records(on_grid).col(0).unaryExpr([](const double m) { return m > 0 ? 1 / m : 0.0; });
    make_fit();
    find_largest_rate();
  }

  void FineScaleAbsorber::make_fit()
  {
    affine.resize(mass.size(), carriers.dimension + 1);
    affine.col(0).setOnes();
    Vector3d centre = Vector3d::Zero();
    for (std::size_t k = 0; k < size(); ++k)
      centre += mass[static_cast<Index>(k)] / mass.sum() * place(k);
    for (std::size_t k = 0; k < size(); ++k)
      affine.row(static_cast<Index>(k)).tail(carriers.dimension) =
        (place(k) - centre).head(carriers.dimension).transpose();
    const Eigen::MatrixXd moments = affine.transpose() * mass.asDiagonal() * affine;
    // What all carriers have in common along an axis (a row of them) says nothing there.
    fit = moments.completeOrthogonalDecomposition().solve(affine.transpose() * mass.asDiagonal());
  }

  void FineScaleAbsorber::take_off_averages(base::Column &all) const
  {
    Records fine = records(all);
    fine -= (affine * (fit * fine)).eval();
    averaged.resize(all.size());
    for (int k = 0; k < sharpness; ++k)
      {
        records(averaged) = mass.asDiagonal() * fine;
        grid.spread(averaged, on_grid);
        records(on_grid).array().colwise() *= inverse_grid_mass.array();
        grid.gather(on_grid, averaged);
        fine -= records(averaged);
      }
  }

  void FineScaleAbsorber::take_off_averages_transposed(base::Column &all) const
  {
    Records force = records(all);
    averaged.resize(all.size());
    for (int k = 0; k < sharpness; ++k)
      {
        grid.spread(all, on_grid);
        records(on_grid).array().colwise() *= inverse_grid_mass.array();
        grid.gather(on_grid, averaged);
        force -= mass.asDiagonal() * records(averaged);
      }
    force -= (fit.transpose() * (affine.transpose() * force)).eval();
  }

  CarrierChanges FineScaleAbsorber::forces(const CarrierRows &particles, const CarrierRows &nodes) const
  {
    const Index of_particles = carriers.whole_mass.size(), of_points = carriers.point_mass.size();
    of_all.assign(record * size(), 0.0);
    Records all                        = records(of_all);
    all.topLeftCorner(of_particles, 3) = particles;
    all.bottomLeftCorner(of_points, 3) = carriers.weights * nodes;
    take_off_averages(of_all);
    all.topRows(of_particles) = carriers.damping.asDiagonal() * all.topRows(of_particles);
    all.bottomRows(of_points).setZero();
    take_off_averages_transposed(of_all);
    return {all.topLeftCorner(of_particles, 3), points_of_nodes * CarrierRows(all.bottomLeftCorner(of_points, 3))};
  }

  CarrierChanges
  FineScaleAbsorber::changes(const CarrierRows &particles, const CarrierRows &nodes, const double time) const
  {
    // Explicit sub-steps contract in the norm of the masses up to twice the time of the largest rate; with 1.8 of
    // it the tables of tests/verification/wave_transmission.cc are missed.
    const int    steps = std::max(1, static_cast<int>(std::ceil(time * fastest)));
    const double step  = time / steps;
    CarrierRows  p = particles, n = nodes;
    for (int s = 0; s < steps; ++s)
      {
        const CarrierChanges force = forces(p, n);
        p -= step * carriers.inverse_mass.cwiseProduct(force.particles);
        n -= step * carriers.inverse_node_mass.cwiseProduct(force.nodes);
      }
    return {p - particles, n - nodes};
  }

  void FineScaleAbsorber::find_largest_rate()
  {
    // Power iteration from an irregular start; it approaches the largest eigenvalue from below.
    constexpr int    iterations = 40;
    constexpr double margin     = 1.1;
    const auto       irregular  = [](const Index rows, const double phase) {
      CarrierRows start(rows, 3);
      for (Index r = 0; r < rows; ++r)
        for (int c = 0; c < 3; ++c)
          start(r, c) = std::sin(phase + 2.399963 * static_cast<double>(r) + 1.1 * c);
      return start;
    };
    CarrierRows p = irregular(carriers.whole_mass.size(), 0.3), n = irregular(carriers.inverse_node_mass.rows(), 0.7);
    for (int i = 0; i < iterations; ++i)
      {
        const double size = std::sqrt(p.squaredNorm() + n.squaredNorm());
        if (!(size > 0))
          return;
        const CarrierChanges force = forces(p / size, n / size);
        p                          = carriers.inverse_mass.cwiseProduct(force.particles);
        n                          = carriers.inverse_node_mass.cwiseProduct(force.nodes);
        fastest                    = margin * std::sqrt(p.squaredNorm() + n.squaredNorm());
      }
  }
} // namespace coupling
