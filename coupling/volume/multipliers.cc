#include "coupling/volume/multipliers.h"

#include <stdexcept>

namespace coupling
{
  using Eigen::VectorXd;

  namespace
  {
    /** What keeps the factor of a singular system finite, over its largest diagonal: constraints may say the same thing twice. */
    constexpr double ridge = 1e-10;
    /** Of a system that needs no ridge, over the largest. */
    constexpr double smallest_pivot = 1e-10;
    /** Each pass takes what the ridge has changed by its ratio to the smallest eigenvalue that counts. */
    constexpr int passes_of_refinement = 2;

    WeightRows identity(const Eigen::Index n)
    {
      WeightRows one(n, n);
      one.setIdentity();
      return one;
    }
  } // namespace

  void Multipliers::factor(const Eigen::SparseMatrix<double> &system, Axis &axis)
  {
    for (std::size_t before = 0; &axes[before] != &axis; ++before)
      if (axes[before].factor && axes[before].particles == axis.particles && axes[before].nodes == axis.nodes)
        {
          axis.factor = axes[before].factor;
          axis.system = axes[before].system;
          return;
        }
    axis.factor           = std::make_shared<Factor>(system);
    const auto well_posed = [](const VectorXd &pivots) {
      return pivots.minCoeff() > smallest_pivot * pivots.maxCoeff();
    };
    if (axis.factor->info() == Eigen::Success && well_posed(axis.factor->vectorD()))
      return;
    axis.system = system;
    Eigen::SparseMatrix<double> raised(system.rows(), system.cols());
    raised.setIdentity();
    raised      = system + ridge * VectorXd(system.diagonal()).maxCoeff() * raised;
    axis.factor = std::make_shared<Factor>(raised);
    if (axis.factor->info() != Eigen::Success)
      throw std::runtime_error("the system of the multipliers cannot be factored.");
  }

  Multipliers::Multipliers(const WeightRows   &weights,
                           const CarrierRows  &particles,
                           const CarrierRows  &nodes,
                           const Compatibility compatibility,
                           const bool          lumped)
    : rows_on_particles(compatibility == Compatibility::strict ? identity(weights.rows()) :
                                                                 WeightRows(weights.transpose()))
    , rows_on_nodes(rows_on_particles * weights)
    , of_particles(rows_on_particles.transpose())
    , of_nodes(rows_on_nodes.transpose())
  {
    for (int c = 0; c < 3; ++c)
      {
        Axis &axis     = axes[static_cast<std::size_t>(c)];
        axis.particles = particles.col(c);
        axis.nodes     = nodes.col(c);
        if (axis.particles.isZero(0) && axis.nodes.isZero(0))
          continue; // nothing can move along it
        const Eigen::SparseMatrix<double> a = rows_on_particles * axis.particles.asDiagonal() * of_particles +
                                              rows_on_nodes * axis.nodes.asDiagonal() * of_nodes;
        if (lumped)
          {
            axis.lumped = a * VectorXd::Ones(a.cols());
            axis.lumped = axis.lumped.unaryExpr([](const double sum) { return sum > 0 ? 1 / sum : 0.0; });
            continue;
          }
        factor(a, axis);
      }
  }

  VectorXd Multipliers::solve(const Axis &axis, const VectorXd &right) const
  {
    if (!axis.factor)
      return axis.lumped.cwiseProduct(right);
    VectorXd lambda = axis.factor->solve(right);
    for (int pass = 0; axis.system.size() > 0 && pass < passes_of_refinement; ++pass)
      lambda += axis.factor->solve(right - axis.system * lambda);
    return lambda;
  }

  CarrierChanges Multipliers::changes(const CarrierRows &particles, const CarrierRows &nodes) const
  {
    CarrierChanges change{CarrierRows::Zero(particles.rows(), 3), CarrierRows::Zero(nodes.rows(), 3)};
    for (int c = 0; c < 3; ++c)
      {
        const Axis &axis = axes[static_cast<std::size_t>(c)];
        if (!axis.factor && axis.lumped.size() == 0)
          continue;
        const VectorXd lambda =
          solve(axis, rows_on_particles * VectorXd(particles.col(c)) - rows_on_nodes * VectorXd(nodes.col(c)));
        change.particles.col(c) = -axis.particles.cwiseProduct(VectorXd(of_particles * lambda));
        change.nodes.col(c)     = axis.nodes.cwiseProduct(VectorXd(of_nodes * lambda));
      }
    return change;
  }
} // namespace coupling
