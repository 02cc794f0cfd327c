// The approximate inverse that ranks share, against what it is made of, written out anew: doc/theory/quasi-static-path.md, (2).
#include "dem/linear/brick_factor.h"

#include "dem/linear/brick_residuals.h"
#include "rank_threads.h"

#include <Eigen/Geometry>
#include <Eigen/SparseLU>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <random>

namespace
{
  using Sparse = Eigen::SparseMatrix<double>;

  constexpr int rows = 600, per_brick = 256; // three bricks, the last not full

  /** A chain of unlike, unsymmetric blocks: an incomplete factor of it leaves nothing out. */
  struct Chain
  {
    dem::RowParticles particles;
    dem::LinkEnds     links;
    dem::BlockMatrix  matrix{rows, joined()};
    Eigen::VectorXd   diagonal = Eigen::VectorXd::Constant(dem::motions * rows, 10.0);
    base::Column      right    = base::Column(dem::motions * rows);

    Chain()
    {
      std::mt19937                           draw(3);
      std::uniform_real_distribution<double> number(-1, 1);
      particles.scale = 0.5;
      for (int row = 0; row < rows; ++row)
        {
          particles.place.emplace_back(row + 0.2 * number(draw), number(draw), number(draw));
          particles.held.push_back(row % 50 == 7 ? 0x2d : 0);
          for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
            {
              matrix.block(k) = dem::Block::NullaryExpr([&] { return number(draw); });
              if (matrix.column(k) == row)
                matrix.block(k).diagonal().array() += 10;
            }
          for (int c = 0; c < dem::motions; ++c)
            right[dem::motions * row + c] = particles.held.back() >> c & 1 ? 0.0 : number(draw);
        }
      for (int row = 0; row < rows; ++row)
        matrix.hold(row, particles.held[row], 10);
      for (const auto &[one, other] : joined())
        {
          links.first.push_back(one);
          links.second.push_back(other);
        }
    }

    static std::vector<std::pair<int, int>> joined()
    {
      std::vector<std::pair<int, int>> all;
      for (int row = 1; row < rows; ++row)
        all.emplace_back(row - 1, row);
      return all;
    }

    /** With `bricks_alone` without what joins one brick with another. */
    Sparse whole(const bool bricks_alone) const
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (int row = 0; row < rows; ++row)
        for (int k = matrix.begin(row); k < matrix.begin(row + 1); ++k)
          for (int i = 0; i < dem::motions && (!bricks_alone || matrix.column(k) / per_brick == row / per_brick); ++i)
            for (int j = 0; j < dem::motions; ++j)
              entries.emplace_back(dem::motions * row + i, dem::motions * matrix.column(k) + j, matrix.block(k)(i, j));
      Sparse all(dem::motions * rows, dem::motions * rows);
      all.setFromTriplets(entries.begin(), entries.end());
      return all;
    }

    /** Rigid motions of bricks: a turn moves what is at r by w x r. */
    Eigen::MatrixXd rigid_motions() const
    {
      Eigen::MatrixXd P = Eigen::MatrixXd::Zero(dem::motions * rows, dem::motions * 3);
      for (int brick = 0; brick < 3; ++brick)
        {
          const int       first = per_brick * brick, end = std::min(rows, first + per_brick);
          Eigen::Vector3d middle = Eigen::Vector3d::Zero();
          for (int row = first; row < end; ++row)
            middle += particles.place[row] / (end - first);
          for (int row = first; row < end; ++row)
            for (int c = 0; c < 3; ++c)
              {
                const Eigen::Vector3d axis = Eigen::Vector3d::Unit(c);
                const int             at = dem::motions * row, column = dem::motions * brick;
                P(at + c, column + c)                 = 1;
                P.block<3, 1>(at, column + 3 + c)     = axis.cross(particles.place[row] - middle) / particles.scale;
                P.block<3, 1>(at + 3, column + 3 + c) = axis;
              }
        }
      for (int row = 0; row < rows; ++row)
        for (int c = 0; c < dem::motions; ++c)
          if (particles.held[row] >> c & 1)
            P.row(dem::motions * row + c).setZero();
      return P;
    }
  };

  Eigen::VectorXd solve(const Sparse &matrix, const Eigen::VectorXd &right)
  {
    Eigen::SparseLU<Sparse> factor(matrix);
    return factor.solve(right);
  }
} // namespace

TEST_CASE("brick factor: it answers with each brick by itself and with their rigid motions", "[dem][statics][ranks]")
{
  const Chain           chain;
  dem::RowShare         share(rows, chain.links, dem::motions, nullptr);
  dem::BrickFactor      factor(chain.particles, chain.links, share);
  std::vector<float>    answer(chain.right.size());
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(chain.right.data(), dem::motions * rows);
  REQUIRE(factor.compute(chain.matrix, chain.diagonal));
  Eigen::VectorXd none;
  factor.apply(chain.right.data(), answer.data(), none, none);
  const Eigen::MatrixXd P     = chain.rigid_motions();
  const Eigen::MatrixXd small = P.transpose() * (chain.whole(false) * P);
  const Eigen::VectorXd exact =
    solve(chain.whole(true), right) + P * small.partialPivLu().solve(Eigen::VectorXd(P.transpose() * right));
  const Eigen::VectorXd found = Eigen::Map<const Eigen::VectorXf>(answer.data(), exact.size()).cast<double>();
  CHECK((found - exact).norm() < 1e-5 * exact.norm()); // single precision, and 1e-6 of the diagonal
}

TEST_CASE("minimal residuals by bricks: the solution is that of a factor, with the same bits on any number of ranks",
          "[dem][statics][ranks]")
{
  const Chain           chain;
  const Eigen::VectorXd exact =
    solve(chain.whole(false), Eigen::Map<const Eigen::VectorXd>(chain.right.data(), dem::motions * rows));
  const auto solution = [&](dem::Ranks *const ranks) {
    dem::RowShare       share(rows, chain.links, dem::motions, ranks);
    dem::BrickFactor    factor(chain.particles, chain.links, share);
    dem::BrickResiduals iteration(share, rows);
    dem::BrickVector    x{base::Column(chain.right.size(), 0.0), {}};
    factor.compute(chain.matrix, chain.diagonal);
    if (!(iteration.solve({chain.matrix, factor}, {chain.right, {}}, 1e-12, 200, x).residual <= 1e-12))
      x.rows.clear();
    return x.rows;
  };
  const base::Column alone = solution(nullptr);
  REQUIRE(alone.size() == chain.right.size());
  CHECK((Eigen::Map<const Eigen::VectorXd>(alone.data(), exact.size()) - exact).norm() < 1e-10 * exact.norm());
  for (const std::size_t ranks : {1, 2, 3, 5})
    {
      std::vector<char> same(ranks, 0);
      rank_threads::run(ranks, [&](const std::shared_ptr<dem::Ranks> &team) {
        const base::Column x = solution(team.get());
        same[team->rank()] =
          x.size() == alone.size() && std::memcmp(x.data(), alone.data(), x.size() * sizeof(double)) == 0;
      });
      INFO(ranks << " ranks");
      CHECK(std::count(same.begin(), same.end(), 1) == static_cast<std::ptrdiff_t>(ranks));
    }
}

namespace
{
  /** Unknowns beside a chain, of which three rows of different bricks feel something. */
  struct Beside
  {
    static constexpr int            size = 7;
    const std::vector<std::int32_t> rows{3, 300, 599};
    dem::BrickBorder::Blocks        blocks;
    Sparse                          modes{size, 2};
    Eigen::VectorXd                 right;

    Beside()
    {
      std::mt19937                           draw(5);
      std::uniform_real_distribution<double> number(-1, 1);
      const auto                             some = [&](const Eigen::Index n, const Eigen::Index m) {
        return Eigen::MatrixXd::NullaryExpr(n, m, [&] { return number(draw); }).eval();
      };
      const auto      joined = static_cast<Eigen::Index>(dem::motions * rows.size());
      Eigen::MatrixXd C = some(joined, size), D = some(size, joined);
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (int c = 0; c < dem::motions; ++c)
          if (const auto at = static_cast<Eigen::Index>(dem::motions * k) + c; rows[k] % 50 == 7 && (0x2d >> c & 1))
            C.row(at).setZero(), D.col(at).setZero();
      blocks = {C.sparseView(), D.sparseView(),
                (some(size, size) + 8 * Eigen::MatrixXd::Identity(size, size)).sparseView()};
      modes  = some(size, 2).sparseView();
      right  = some(size, 1);
    }

    /** With the rows of a chain. */
    Sparse whole(const Sparse &chain) const
    {
      std::vector<Eigen::Triplet<double>> entries;
      const auto                          n   = static_cast<int>(chain.rows());
      const auto                          add = [&](const Sparse &block, const auto &row, const auto &column) {
        for (Eigen::Index k = 0; k < block.outerSize(); ++k)
          for (Sparse::InnerIterator e(block, k); e; ++e)
            entries.emplace_back(row(static_cast<int>(e.row())), column(static_cast<int>(e.col())), e.value());
      };
      const auto as_it_is = [](const int i) { return i; };
      const auto behind   = [n](const int i) { return n + i; };
      const auto at_rows  = [this](const int i) { return dem::motions * rows[i / dem::motions] + i % dem::motions; };
      add(chain, as_it_is, as_it_is);
      add(blocks.C, at_rows, behind);
      add(blocks.D, behind, at_rows);
      add(blocks.E, behind, behind);
      Sparse all(n + size, n + size);
      all.setFromTriplets(entries.begin(), entries.end());
      return all;
    }
  };
} // namespace

TEST_CASE("brick factor: a border answers by a factor of its own, and with its modes where bricks move rigidly",
          "[dem][statics][ranks]")
{
  const Chain      chain;
  const Beside     beside;
  dem::RowShare    share(rows, chain.links, dem::motions, nullptr);
  dem::BrickBorder border(beside.rows, beside.modes, share);
  border.set(beside.blocks);
  REQUIRE(border.factorize(beside.blocks.E, false));
  dem::BrickFactor   factor(chain.particles, chain.links, share, &border);
  std::vector<float> answer(chain.right.size());
  Eigen::VectorXd    of_border;
  REQUIRE(factor.compute(chain.matrix, chain.diagonal));
  factor.apply(chain.right.data(), answer.data(), beside.right, of_border);

  const int       n = dem::motions * rows;
  Eigen::VectorXd right(n + Beside::size), alone(right.size());
  right << Eigen::Map<const Eigen::VectorXd>(chain.right.data(), n), beside.right;
  alone << solve(chain.whole(true), right.head(n)), solve(beside.blocks.E, beside.right);
  Eigen::MatrixXd P                                      = Eigen::MatrixXd::Zero(right.size(), 3 * dem::motions + 2);
  P.topLeftCorner(n, 3 * dem::motions)                   = chain.rigid_motions();
  P.bottomRightCorner(static_cast<int>(Beside::size), 2) = beside.modes;
  const Eigen::MatrixXd small                            = P.transpose() * (beside.whole(chain.whole(false)) * P);
  const Eigen::VectorXd exact = alone + P * small.partialPivLu().solve(Eigen::VectorXd(P.transpose() * right));
  const Eigen::VectorXd found = Eigen::Map<const Eigen::VectorXf>(answer.data(), n).cast<double>();
  CHECK((found - exact.head(n)).norm() < 1e-5 * exact.norm());
  CHECK((of_border - exact.tail(static_cast<int>(Beside::size))).norm() < 1e-7 * exact.norm());
}

TEST_CASE("minimal residuals by bricks: with a border too the solution is a factor's, with the same bits on ranks",
          "[dem][statics][ranks]")
{
  const Chain     chain;
  const Beside    beside;
  const int       n = dem::motions * rows;
  Eigen::VectorXd right(n + Beside::size);
  right << Eigen::Map<const Eigen::VectorXd>(chain.right.data(), n), beside.right;
  const Eigen::VectorXd exact    = solve(beside.whole(chain.whole(false)), right);
  const auto            solution = [&](dem::Ranks *const ranks) {
    dem::RowShare    share(rows, chain.links, dem::motions, ranks);
    dem::BrickBorder border(beside.rows, beside.modes, share);
    border.set(beside.blocks);
    border.factorize(beside.blocks.E, false);
    dem::BrickFactor    factor(chain.particles, chain.links, share, &border);
    dem::BrickResiduals iteration(share, rows);
    dem::BrickVector    x{base::Column(chain.right.size(), 0.0), Eigen::VectorXd::Zero(Beside::size)};
    factor.compute(chain.matrix, chain.diagonal);
    const double left =
      iteration.solve({chain.matrix, factor, &border}, {chain.right, beside.right}, 1e-12, 200, x).residual;
    Eigen::VectorXd all(right.size());
    all << Eigen::Map<const Eigen::VectorXd>(x.rows.data(), n), x.border;
    return left <= 1e-12 ? all : Eigen::VectorXd();
  };
  const Eigen::VectorXd alone = solution(nullptr);
  REQUIRE(alone.size() == exact.size());
  CHECK((alone - exact).norm() < 1e-10 * exact.norm());
  for (const std::size_t ranks : {1, 2, 3, 5})
    {
      std::vector<char> same(ranks, 0);
      rank_threads::run(ranks, [&](const std::shared_ptr<dem::Ranks> &team) {
        const Eigen::VectorXd x = solution(team.get());
        same[team->rank()]      = x.size() == alone.size() && x == alone;
      });
      INFO(ranks << " ranks");
      CHECK(std::count(same.begin(), same.end(), 1) == static_cast<std::ptrdiff_t>(ranks));
    }
}
