#include "coupling/volume/multipliers.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
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

  Multipliers::Factor::Factor(const Eigen::SparseMatrix<double> &system)
  {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> made(system);
    valid = made.info() == Eigen::Success && system.rows() > 0;
    if (!valid)
      return;
    lower  = made.matrixL().nestedExpression();
    pivots = made.vectorD();
    order  = made.permutationP();
  }

  void Multipliers::Factor::solve(const CarrierRows &right, CarrierRows &solution) const
  {
    // All columns on the way through the factor, which is what costs.
    solution                 = order * right;
    const Eigen::Index rows  = lower.rows();
    const int         *first = lower.outerIndexPtr(), *row_of = lower.innerIndexPtr();
    const double      *entry   = lower.valuePtr();
    constexpr int      columns = CarrierRows::ColsAtCompileTime;
    double *const      x       = solution.data();
    for (Eigen::Index j = 0; j < rows; ++j)
      for (int at = first[j]; at < first[j + 1]; ++at)
        for (int c = 0; c < columns; ++c)
          x[columns * row_of[at] + c] -= entry[at] * x[columns * j + c];
    solution.array().colwise() /= pivots.array();
    for (Eigen::Index j = rows - 1; j >= 0; --j)
      for (int at = first[j]; at < first[j + 1]; ++at)
        for (int c = 0; c < columns; ++c)
          x[columns * j + c] -= entry[at] * x[columns * row_of[at] + c];
    solution = (order.transpose() * solution).eval();
  }

  void Multipliers::factor(Group &group, const Eigen::SparseMatrix<double> &system)
  {
    group.factor = Factor(system);
    if (group.factor.valid && group.factor.pivots.minCoeff() > smallest_pivot * group.factor.pivots.maxCoeff())
      return;
    group.system = system;
    Eigen::SparseMatrix<double> raised(system.rows(), system.cols());
    raised.setIdentity();
    raised       = system + ridge * VectorXd(system.diagonal()).maxCoeff() * raised;
    group.factor = Factor(raised);
    if (!group.factor.valid)
      throw std::runtime_error("the system of the multipliers cannot be factored.");
  }

  Multipliers::Multipliers(const WeightRows  &weights,
                           const CarrierRows &particles,
                           const CarrierRows &nodes,
                           const VectorXd    &parts,
                           const bool         lumped)
    : rows_on_particles(parts.size() == 0 ? identity(weights.rows()) :
                                            WeightRows(weights.transpose() * parts.asDiagonal()))
    , rows_on_nodes(rows_on_particles * weights)
    , of_particles(rows_on_particles.transpose())
    , of_nodes(rows_on_nodes.transpose())
    , inverse_particles(particles)
    , inverse_nodes(nodes)
  {
    for (int c = 0; c < 3; ++c)
      {
        const VectorXd of_axis = particles.col(c), of_axis_nodes = nodes.col(c);
        if (of_axis.isZero(0) && of_axis_nodes.isZero(0))
          continue; // nothing can move along it
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group &group) {
          const int other = group.axes.front();
          return particles.col(other) == of_axis && nodes.col(other) == of_axis_nodes;
        });
        if (same != groups.end())
          {
            same->axes.push_back(c);
            continue;
          }
        groups.emplace_back();
        groups.back().axes = {c};
        if (parts.size() == 0 && !lumped && (of_axis.array() > 0).all())
          {
            factor_riding(groups.back(), of_axis, of_axis_nodes);
            continue;
          }
        const Eigen::SparseMatrix<double> a = rows_on_particles * of_axis.asDiagonal() * of_particles +
                                              rows_on_nodes * of_axis_nodes.asDiagonal() * of_nodes;
        if (lumped)
          {
            groups.back().lumped = a * VectorXd::Ones(a.cols());
            groups.back().lumped =
              groups.back().lumped.unaryExpr([](const double sum) { return sum > 0 ? 1 / sum : 0.0; });
          }
        else
          factor(groups.back(), a);
      }
  }

  void Multipliers::factor_riding(Group &group, const VectorXd &particles, const VectorXd &nodes) const
  {
    // Of A = m^-1 + N M^-1 N^T only M + N^T m N, as small as there are nodes, has to be factored (Woodbury).
    group.riding                       = particles.cwiseInverse();
    Eigen::SparseMatrix<double> system = of_nodes * group.riding.asDiagonal() * rows_on_nodes;
    const VectorXd              free   = nodes.unaryExpr([](const double inverse) { return inverse > 0 ? 1.0 : 0.0; });
    system                             = free.asDiagonal() * system * free.asDiagonal();
    const VectorXd own = nodes.unaryExpr([](const double inverse) { return inverse > 0 ? 1 / inverse : 1.0; });
    Eigen::SparseMatrix<double> masses(system.rows(), system.cols());
    masses.setIdentity();
    masses       = own.asDiagonal() * masses;
    group.factor = Factor(system + masses);
    if (!group.factor.valid)
      throw std::runtime_error("the masses that particles and nodes have together cannot be factored.");
  }

  void Multipliers::follow(const Group &group, const CarrierRows &lacking, CarrierChanges &change) const
  {
    CarrierRows right = of_nodes * (group.riding.asDiagonal() * lacking), nodes;
    for (Eigen::Index k = 0; k < right.rows(); ++k)
      if (!(inverse_nodes(k, group.axes.front()) > 0))
        right.row(k).setZero();
    group.factor.solve(right, nodes);
    const CarrierRows at_particles = rows_on_nodes * nodes;
    for (const int c : group.axes)
      {
        change.nodes.col(c)     = nodes.col(c);
        change.particles.col(c) = at_particles.col(c) - lacking.col(c);
      }
  }

  CarrierRows Multipliers::solve(const Group &group, const CarrierRows &right) const
  {
    if (group.lumped.size() > 0)
      return group.lumped.asDiagonal() * right;
    CarrierRows lambda, further;
    group.factor.solve(right, lambda);
    for (int pass = 0; group.system.size() > 0 && pass < passes_of_refinement; ++pass)
      {
        group.factor.solve(right - group.system * lambda, further);
        lambda += further;
      }
    return lambda;
  }

  CarrierChanges Multipliers::changes(const CarrierRows &particles, const CarrierRows &nodes) const
  {
    const CarrierRows lacking = rows_on_particles * particles - rows_on_nodes * nodes;
    CarrierRows       lambda  = CarrierRows::Zero(lacking.rows(), 3);
    for (const Group &group : groups)
      {
        if (group.riding.size() > 0)
          continue;
        const CarrierRows found = solve(group, lacking);
        for (const int c : group.axes)
          lambda.col(c) = found.col(c);
      }
    CarrierChanges change{-inverse_particles.cwiseProduct(of_particles * lambda),
                          inverse_nodes.cwiseProduct(of_nodes * lambda)};
    for (const Group &group : groups)
      if (group.riding.size() > 0)
        follow(group, lacking, change);
    return change;
  }
} // namespace coupling
