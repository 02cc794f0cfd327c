// The linear systems of cells by iteration, against their factors and closed forms.
#include "dem/statics/tangent_iteration.h"

#include "clusters.h"
#include "dem/cells/cell_system.h"
#include "dem/laws/cpm.h"
#include "dem/linear/minimal_residuals.h"
#include "dem/statics/damaging_links.h"
#include "tests/dem/homogenisation_fixture.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <random>

using homogenisation_fixture::relative_difference;

namespace
{
  /** Rows in a ring, each joined with two on either side; unsymmetric. */
  dem::BlockMatrix ring(const int rows)
  {
    std::vector<std::pair<int, int>> joined;
    for (int i = 0; i < rows; ++i)
      for (int k = 1; k <= 2; ++k)
        joined.emplace_back(i, (i + k) % rows);
    dem::BlockMatrix                       matrix(rows, joined);
    std::mt19937                           draw(4);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int row = 0; row < rows; ++row)
      for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
        {
          matrix.block(k) = dem::Block::NullaryExpr([&] { return number(draw); });
          if (matrix.column(k) == row)
            matrix.block(k).diagonal().array() += 8;
        }
    return matrix;
  }

  Eigen::MatrixXd dense(const dem::BlockMatrix &matrix)
  {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(matrix.size(), matrix.size());
    for (int row = 0; row < matrix.rows(); ++row)
      for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
        all.block<6, 6>(6 * row, 6 * matrix.column(k)) = matrix.block(k);
    return all;
  }

  struct DamagedCell
  {
    dem::CpmParameters law = cluster::concrete();
    dem::LoadedNetwork loaded;
    dem::DamagingLinks links;

    /** All particles carried evenly to a strain at which some links damage, some slide and most do neither. */
    explicit DamagedCell(const double size)
      : loaded(dem::strained_cell(dem::make_network(
          homogenisation_fixture::random_spheres(60, 3), homogenisation_fixture::links(1.6, 0.2, 25e9), law)))
      , links(loaded, law)
    {
      dem::LoadedMotion motion(loaded.held.size());
      motion.loads << size, -0.3 * size, 0.2 * size, 0.4 * size, -0.2 * size, 0.5 * size;
      links.evaluate(motion);
    }
  };
} // namespace

TEST_CASE("tangent iteration: blocks multiply and hold as a matrix does", "[dem][statics]")
{
  dem::BlockMatrix      matrix = ring(9);
  const Eigen::VectorXd x      = Eigen::VectorXd::LinSpaced(matrix.size(), -1, 2);
  Eigen::VectorXd       y(matrix.size());
  matrix.multiply<1>(x, y);
  CHECK((y - dense(matrix) * x).norm() < 1e-13 * y.norm());
  dem::Columns<6> six(matrix.size(), 6), products(matrix.size(), 6);
  for (int i = 0; i < 6; ++i)
    six.col(i) = (i - 2) * x.array() + x.array().square();
  matrix.multiply<6>(six, products);
  CHECK((products - dense(matrix) * six).norm() < 1e-13 * products.norm());
  matrix.hold(4, 0x5, 7);
  const Eigen::MatrixXd held = dense(matrix);
  for (const int k : {24, 26})
    {
      CHECK(held.row(k).cwiseAbs().sum() == 7);
      CHECK(held.col(k).cwiseAbs().sum() == 7);
    }
}

TEST_CASE("tangent iteration: it ends at the accuracy that it says, for unsymmetric systems too", "[dem][statics]")
{
  const dem::BlockMatrix       matrix = ring(40);
  dem::IncompleteFactor<float> factor;
  REQUIRE(factor.compute(matrix, Eigen::VectorXd::Zero(matrix.size())));
  const Eigen::VectorXd    b = Eigen::VectorXd::LinSpaced(matrix.size(), 1, -3);
  dem::MinimalResiduals<1> iteration;
  Eigen::VectorXd          x;
  for (const double accuracy : {1e-2, 1e-6, 1e-12})
    {
      x.resize(0);
      const dem::ResidualLeft left = iteration.solve(matrix, factor, b, accuracy, 200, x);
      CHECK(left.residual <= accuracy);
      CHECK((b - dense(matrix) * x).norm() == Approx(left.residual * b.norm()).margin(1e-14 * b.norm()));
    }
  CHECK((x - dense(matrix).partialPivLu().solve(b)).norm() < 1e-10 * x.norm());
  x.resize(0);
  CHECK(iteration.solve(matrix, factor, 0 * b, 1e-12, 200, x).residual == 0);
  CHECK(x.isZero(0));
  CHECK(iteration.solve(matrix, factor, b, 1e-12, 1, x).residual > 1e-12); // it says where it did not get
}

TEST_CASE("tangent iteration: six right sides together are each solved as alone, from any start", "[dem][statics]")
{
  const dem::BlockMatrix       matrix = ring(40);
  dem::IncompleteFactor<float> factor;
  REQUIRE(factor.compute(matrix, Eigen::VectorXd::Zero(matrix.size())));
  dem::MinimalResiduals<1> alone;
  dem::MinimalResiduals<6> together;
  dem::Columns<6>          b(matrix.size(), 6), x;
  for (int i = 0; i < 6; ++i)
    b.col(i) = i * Eigen::VectorXd::LinSpaced(matrix.size(), 1, -3).array().pow(i); // the first is zero
  const dem::ResidualLeft left = together.solve(matrix, factor, b, 1e-10, 200, x);
  CHECK(left.residual <= 1e-10);
  CHECK(x.col(0).isZero(0));
  for (int i = 1; i < 6; ++i)
    {
      Eigen::VectorXd one;
      alone.solve(matrix, factor, b.col(i), 1e-10, 200, one);
      CHECK((x.col(i) - one).norm() < 1e-9 * one.norm());
    }
  // From near by it takes less, and from far off it is no worse than from zero.
  dem::Columns<6> near_by = 1.001 * x, far_off = 100 * x;
  CHECK(together.solve(matrix, factor, b, 1e-10, 200, near_by).iterations < left.iterations);
  CHECK(together.solve(matrix, factor, b, 1e-10, 200, far_off).iterations == left.iterations);
  CHECK((near_by - x).norm() < 1e-9 * x.norm());
}

TEST_CASE("tangent iteration: of a tridiagonal chain of blocks the incomplete factor is the factor", "[dem][statics]")
{
  std::vector<std::pair<int, int>> joined;
  for (int i = 0; i + 1 < 12; ++i)
    joined.emplace_back(i, i + 1);
  const dem::BlockMatrix full = ring(12);
  dem::BlockMatrix       chain(12, joined);
  for (int row = 0; row < 12; ++row)
    for (int k = chain.begin(row); k < chain.begin(row + 1); ++k)
      chain.block(k) = full.block(full.place(row, chain.column(k)));
  dem::IncompleteFactor<double> factor;
  REQUIRE(factor.compute(chain, Eigen::VectorXd::Zero(chain.size())));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(chain.size(), 1, 2);
  Eigen::VectorXd       x(b.size());
  factor.apply<1>({b.data()}, {x.data()});
  CHECK((dense(chain) * x - b).norm() < 1e-12 * b.norm());
  dem::IncompleteFactor<float> in_single;
  REQUIRE(in_single.compute(chain, Eigen::VectorXd::Zero(chain.size())));
  Eigen::VectorXf rough(b.size());
  in_single.apply<1>({b.data()}, {rough.data()});
  CHECK((rough.cast<double>() - x).norm() < 1e-5 * x.norm());
  chain.block(chain.diagonal(0)).setZero();
  CHECK_FALSE(factor.compute(chain, Eigen::VectorXd::Zero(chain.size())));
}

TEST_CASE("tangent iteration: cells whose links damage and slide answer as by a factor", "[dem][statics]")
{
  for (const double size : {1e-6, 1.5e-4, 4e-4, -4e-4})
    {
      const DamagedCell     cell(size);
      const auto            stiffness = cell.links.stiffness(dem::LinkStiffness::consistent);
      dem::CellSystem       by_iteration(cell.loaded), by_factor(cell.loaded, false);
      const base::Vector6   change = base::Vector6::Unit(3) * 1e-5;
      const dem::Unbalanced unbalanced =
        dem::unbalanced_of(cell.loaded, dem::LoadedMotion(cell.loaded.held.size()), cell.links.forces(), {}, 1);
      dem::LoadedMotion a, b;
      REQUIRE(by_iteration.solve(stiffness, unbalanced, change, 1e-12, a));
      REQUIRE(by_factor.solve(stiffness, unbalanced, change, 0, b));
      CHECK((a.particles - b.particles).norm() < 1e-7 * b.particles.norm());
      CHECK(a.loads == b.loads);
      base::Matrix6 D, reference;
      REQUIRE(by_iteration.condense(stiffness, 1e-9, D));
      REQUIRE(by_factor.condense(stiffness, 0, reference));
      CHECK(relative_difference(D, reference) < 1e-8);
    }
}
