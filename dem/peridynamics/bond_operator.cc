#include "dem/peridynamics/bond_operator.h"

#include <Eigen/IterativeLinearSolvers>

namespace dem::peridynamics
{
  namespace
  {
    struct DiagonalInverse
    {
      const Eigen::VectorXd &diagonal;

      Eigen::VectorXd solve(const Eigen::VectorXd &r) const { return r.cwiseQuotient(diagonal); }
    };
  } // namespace

  BondOperator::BondOperator(const Bonds &of, const std::vector<bool> &free)
    : bonds(&of)
    , forces(of, Kinematics::linear)
    , u(of.grid().field())
    , f(u)
  {
    const auto dimension = static_cast<std::size_t>(of.grid().dimension());
    for (const std::size_t place : of.grid().nodes())
      for (std::size_t axis = 0; axis < dimension; ++axis)
        if (free[place * dimension + axis])
          at.push_back({place, axis});
    find_diagonal();
  }

  void BondOperator::find_diagonal()
  {
    const Grid &grid = bonds->grid();
    Field       own  = grid.field();
    bonds->each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      const Offset         &offset = bonds->offsets()[o];
      const Eigen::Vector3d xi(offset.steps[0], offset.steps[1], offset.steps[2]);
      const double          k = bonds->stiffness()[bond] / (offset.length * grid.spacing());
      for (const std::size_t end : {i, j})
        own.add(end, k / (offset.length * offset.length) * xi.cwiseAbs2());
    });
    double sum = 0;
    for (const std::size_t i : grid.nodes())
      sum += own.at(i).sum();
    const double mean = sum / static_cast<double>(grid.nodes().size() * static_cast<std::size_t>(grid.dimension()));
    const auto   n    = static_cast<Eigen::Index>(at.size());
    diagonal.resize(n);
    spring = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k)
      {
        const Unknown &of = at[static_cast<std::size_t>(k)];
        diagonal[k]       = own.c[of.axis][of.place];
        // What nothing holds any more has an ordinary stiffness of its own: it is not loaded, and stays where it is.
        if (diagonal[k] < 1e-14 * mean)
          diagonal[k] = spring[k] = mean;
      }
  }

  Eigen::VectorXd BondOperator::operator*(const Eigen::VectorXd &x) const
  {
    for (std::size_t k = 0; k < at.size(); ++k)
      u.c[at[k].axis][at[k].place] = x[static_cast<Eigen::Index>(k)];
    forces.add_up(*bonds, u, f);
    Eigen::VectorXd product = spring.cwiseProduct(x);
    for (std::size_t k = 0; k < at.size(); ++k)
      product[static_cast<Eigen::Index>(k)] -= f.c[at[k].axis][at[k].place];
    return product;
  }

  double BondOperator::solve(const Eigen::VectorXd &b,
                             const double           tolerance,
                             const int              most_iterations,
                             Eigen::VectorXd       &x) const
  {
    x                       = Eigen::VectorXd::Zero(b.size());
    Eigen::Index iterations = most_iterations;
    double       left       = tolerance; // in: when to stop; out: where it stopped
    // Of a class that is no matrix Eigen's front end would want traits; the iteration itself wants a product.
    Eigen::internal::conjugate_gradient(*this, b, x, DiagonalInverse{diagonal}, iterations, left);
    return left;
  }
} // namespace dem::peridynamics
