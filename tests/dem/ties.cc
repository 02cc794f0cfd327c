// Linear conditions between motions (doc/theory/static-handshake.md, 2).
#include "dem/network/ties.h"

#include "dem/core/uniform_random.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

namespace
{
  using Eigen::MatrixXd, Eigen::VectorXd;

  constexpr std::size_t constrained = 40, joints = 5;

  /** Each of the first carriers moves along each axis as the mean of three of the last ones, with weights of its own. */
  std::vector<dem::Tie> interpolation()
  {
    dem::UniformRandom    random(3);
    std::vector<dem::Tie> ties;
    for (std::size_t i = 0; i < constrained; ++i)
      for (int axis = 0; axis < 3; ++axis)
        {
          dem::Tie tie = {{i, axis, 1.0}};
          for (std::size_t k = 0; k < 3; ++k)
            tie.push_back({constrained + (i + k) % joints, axis, -0.1 - random()});
          ties.push_back(tie);
        }
    return ties;
  }

  VectorXd numbers(const Eigen::Index count, const double least)
  {
    dem::UniformRandom random(11);
    return VectorXd::NullaryExpr(count, [&] { return least + random(); });
  }

  double difference(const VectorXd &a, const VectorXd &b) { return (a - b).norm() / b.norm(); }
} // namespace

TEST_CASE(
  "ties: conditions with a motion of their own are solved as the whole matrix is, and forces lose what ties bear",
  "[dem][statics]")
{
  const std::vector<dem::HeldMotions> free(constrained + joints, 0);
  const dem::Ties                     ties(interpolation(), free, 1.0);
  const auto                         &T = ties.rows();
  REQUIRE(T.rows() == 3 * constrained);
  std::vector<Eigen::Index> own; // of each row
  for (std::size_t i = 0; i < constrained; ++i)
    for (int axis = 0; axis < 3; ++axis)
      own.push_back(static_cast<Eigen::Index>(dem::motions * i) + axis);

  const VectorXd weights = numbers(T.cols(), 0.2), right = numbers(T.rows(), -0.5);
  const VectorXd exact = MatrixXd(T * weights.asDiagonal() * T.transpose()).ldlt().solve(right);
  CHECK(difference(dem::TieFactor(T, weights, own).solve(right), exact) < 1e-10);
  CHECK(difference(dem::TieFactor(T, weights, {}).solve(right), exact) < 1e-10);

  dem::CarrierMotions force(dem::motions, static_cast<Eigen::Index>(constrained + joints));
  Eigen::Map<VectorXd>(force.data(), force.size()) = numbers(force.size(), -0.5);
  const VectorXd before                            = Eigen::Map<VectorXd>(force.data(), force.size());
  const VectorXd borne = T.transpose() * MatrixXd(T * T.transpose()).ldlt().solve(VectorXd(T * before));
  ties.release(force);
  CHECK(difference(Eigen::Map<VectorXd>(force.data(), force.size()), before - borne) < 1e-10);
}
