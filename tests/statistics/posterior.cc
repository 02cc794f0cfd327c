#include "apps/statistics/posterior.h"

#include "apps/statistics/distributions.h"
#include "apps/statistics/space_filling.h"
#include "base/errors.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace statistics;

namespace
{
  constexpr Eigen::Index observations = 12;
  constexpr double       scatter      = 0.1;

  /** A straight line at twelve places. */
  Eigen::MatrixXd line()
  {
    Eigen::MatrixXd matrix(observations, 2);
    matrix << Eigen::VectorXd::Ones(observations), Eigen::VectorXd::LinSpaced(observations, 0, 1);
    return matrix;
  }

  /** Stress over strain that softens: no line in its constants. */
  Eigen::VectorXd softening(const Eigen::VectorXd &c)
  {
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(observations, 0.1, 2);
    return c[0] * x * (-x / c[1]).exp();
  }

  Eigen::VectorXd noisy(Eigen::VectorXd outputs)
  {
    std::mt19937               stream(4);
    std::normal_distribution<> noise(0, scatter);
    for (double &output : outputs)
      output += noise(stream);
    return outputs;
  }

  using Model = std::function<Eigen::VectorXd(const Eigen::VectorXd &)>;

  ModelRuns runs_of(const Model &model, const Box &box, const int count)
  {
    ModelRuns runs{{"a", "b"}, latin_hypercube(count, 2, 3), Eigen::MatrixXd(count, observations)};
    for (Eigen::Index k = 0; k < 2; ++k)
      runs.constants.col(k) = box.lower[k] + runs.constants.col(k).array() * (box.upper[k] - box.lower[k]);
    for (Eigen::Index run = 0; run < count; ++run)
      runs.outputs.row(run) = model(runs.constants.row(run));
    return runs;
  }
} // namespace

TEST_CASE("sampler: draws have the mean and the covariance of the density, however its variables are correlated",
          "[statistics]")
{
  Eigen::Matrix2d covariance;
  covariance << 1, 0.99, 0.99, 1;
  const Eigen::Matrix2d inverse = covariance.inverse();
  const auto            density = [&inverse](const Eigen::VectorXd &x) { return -0.5 * x.dot(inverse * x); };
  const Eigen::MatrixXd starts  = 4 * (latin_hypercube(20, 2, 1).array() - 0.5);
  const Ensemble        drawn   = sampled(density, starts, {5000, 500, 7});
  const Eigen::MatrixXd around  = drawn.places.rowwise() - drawn.places.colwise().mean();
  const Eigen::MatrixXd found   = around.transpose() * around / double(around.rows());
  CHECK(drawn.places.rows() == 100000);
  CHECK(drawn.places.colwise().mean().cwiseAbs().maxCoeff() < 0.05);
  CHECK(found(0, 0) == Approx(1).epsilon(0.05));
  CHECK(found(0, 1) / std::sqrt(found(0, 0) * found(1, 1)) == Approx(0.99).epsilon(1e-3));
  CHECK(drawn.accepted > 0.3);
  CHECK(sampled(density, starts, {10, 5, 7}).places == sampled(density, starts, {10, 5, 7}).places);
  CHECK(sampled(density, starts, {10, 5, 8}).places != sampled(density, starts, {10, 5, 7}).places);
}

TEST_CASE("posterior: of a line with Gaussian errors it is the one that is known, for constants and for outputs",
          "[statistics]")
{
  const bool            known    = GENERATE(true, false); // whether the scatter of observations is
  const Eigen::MatrixXd matrix   = line();
  const Eigen::VectorXd observed = noisy(matrix * Eigen::Vector2d(1, 2));
  const Eigen::Matrix2d inverse  = (matrix.transpose() * matrix).inverse();
  const Eigen::Vector2d best     = inverse * matrix.transpose() * observed;
  const int             degrees  = observations - 2;
  const double          s        = known ? scatter : std::sqrt((observed - matrix * best).squaredNorm() / degrees);
  const double          factor   = known ? 1.959963985 : t_limit(0.025, degrees);
  const Eigen::Vector2d error    = s * inverse.diagonal().cwiseSqrt();

  const Box      box{best - 8 * error, best + 8 * error};
  const Emulator emulator(runs_of([&](const Eigen::VectorXd &c) { return matrix * c; }, box, 30));
  CHECK(emulator.components().cols() == 2);
  CHECK(emulator.error() < 1e-3 * scatter);
  const Posterior found       = posterior(emulator, {observed, known ? scatter : 0.0}, {known ? 5000 : 15000, 500, 1});
  const auto [lower, upper]   = found.band(0.95);
  const auto [bottom, top]    = found.band_of_outputs(0.95);
  const Eigen::VectorXd width = factor * s * (matrix * inverse * matrix.transpose()).diagonal().cwiseSqrt();
  INFO((known ? "known" : "unknown") << " scatter, drift " << found.drift);
  CHECK(found.drift < 0.1);
  for (int k = 0; k < 2; ++k)
    {
      CHECK(std::fabs(found.mean()[k] - best[k]) < 0.05 * error[k]);
      CHECK(lower[k] == Approx(best[k] - factor * error[k]).margin(0.12 * error[k]));
      CHECK(upper[k] == Approx(best[k] + factor * error[k]).margin(0.12 * error[k]));
    }
  for (Eigen::Index k = 0; k < observations; ++k)
    {
      CHECK(bottom[k] == Approx((matrix * best)[k] - width[k]).margin(0.15 * width[k]));
      CHECK(top[k] == Approx((matrix * best)[k] + width[k]).margin(0.15 * width[k]));
    }
}

TEST_CASE("posterior: by an emulator of forty runs it is that of the curved model itself", "[statistics]")
{
  const Box             box{Eigen::Vector2d(2, 0.5), Eigen::Vector2d(4.5, 1.6)};
  const Eigen::VectorXd observed = noisy(softening(Eigen::Vector2d(3, 1)));
  const Emulator        emulator(runs_of(softening, box, 40));
  CHECK(emulator.error() < 0.1 * scatter);
  const Posterior found   = posterior(emulator, {observed, scatter}, {4000, 500, 1});
  const auto      density = [&](const Eigen::VectorXd &c) {
    return box.contains(c) ? -0.5 * (observed - softening(c)).squaredNorm() / (scatter * scatter) : -INFINITY;
  };
  Eigen::MatrixXd starts      = latin_hypercube(20, 2, 9);
  starts.col(0)               = 2 + 2.5 * starts.col(0).array();
  starts.col(1)               = 0.5 + 1.1 * starts.col(1).array();
  const Eigen::MatrixXd exact = sampled(density, starts, {4000, 500, 2}).places;
  const auto [lower, upper]   = found.band(0.95);
  for (int k = 0; k < 2; ++k)
    {
      const double width = quantile(exact.col(k), 0.975) - quantile(exact.col(k), 0.025);
      CHECK(lower[k] == Approx(quantile(exact.col(k), 0.025)).margin(0.04 * width));
      CHECK(upper[k] == Approx(quantile(exact.col(k), 0.975)).margin(0.04 * width));
    }
}

TEST_CASE("posterior: what the emulator does not know makes the band wider", "[statistics]")
{
  const Box             box{Eigen::Vector2d(2, 0.5), Eigen::Vector2d(4.5, 1.6)};
  const Eigen::VectorXd observed = softening(Eigen::Vector2d(3, 1));
  const auto            width    = [&](const int runs) {
    const auto [lower, upper] =
      posterior(Emulator(runs_of(softening, box, runs)), {observed, 0.01}, {500, 200, 1}).band(0.95);
    return Eigen::VectorXd(upper - lower);
  };
  const Eigen::VectorXd few = width(7), many = width(60);
  CHECK(few[0] > 1.5 * many[0]);
  CHECK(few[1] > 1.5 * many[1]);
}

TEST_CASE("posterior: outputs that stand still, too few starts and another number of observations are refused",
          "[statistics]")
{
  const Box box{Eigen::Vector2d(1, 1), Eigen::Vector2d(2, 2)};
  CHECK_THROWS_AS(
    Emulator(runs_of([](const Eigen::VectorXd &) { return Eigen::VectorXd::Ones(observations); }, box, 10)),
    base::InputError);
  const Emulator emulator(runs_of(softening, box, 20));
  CHECK_THROWS_AS(posterior(emulator, {Eigen::VectorXd::Ones(3), 0.1}), base::InputError);
  const auto flat = [](const Eigen::VectorXd &) { return 0.0; };
  CHECK_THROWS_AS(sampled(flat, Eigen::MatrixXd::Random(5, 2), {}), base::InputError);
  CHECK_THROWS_AS(sampled(flat, Eigen::MatrixXd::Random(2, 2), {}), base::InputError);
}
