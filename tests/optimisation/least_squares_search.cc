#include "apps/optimisation/least_squares_search.h"

#include "base/errors.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace optimisation;

namespace
{
  using CurveModel = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd &)>;

  Residuals one_by_one(const CurveModel &model)
  {
    return [model](const std::vector<Eigen::VectorXd> &places) {
      std::vector<std::optional<Eigen::VectorXd>> all;
      for (const Eigen::VectorXd &place : places)
        all.push_back(model(place));
      return all;
    };
  }

  LeastSquaresProblem curve_problem(const Eigen::VectorXd &start, const CurveModel &model, const double step)
  {
    const Eigen::VectorXd infinite = Eigen::VectorXd::Constant(start.size(), INFINITY);
    return {start, -infinite, infinite, Eigen::VectorXd::Constant(start.size(), step), one_by_one(model)};
  }

  std::optional<Eigen::VectorXd> rosenbrock(const Eigen::VectorXd &x)
  {
    return Eigen::VectorXd(Eigen::Vector2d(1 - x[0], 10 * (x[1] - x[0] * x[0])));
  }

  /** Two curves of stress over strain, crushed and pulled, with three constants each. */
  Eigen::VectorXd curves(const Eigen::VectorXd &c)
  {
    Eigen::VectorXd stress(100);
    for (int k = 0; k < 100; ++k)
      {
        const double x = 0.04 * (k % 50 + 1), peak = c[k < 50 ? 1 : 4], r = c[k < 50 ? 2 : 5];
        stress[k] = c[k < 50 ? 0 : 3] * x / peak * r / (r - 1 + std::pow(x / peak, r));
      }
    return stress;
  }

  Eigen::VectorXd constants(const std::vector<double> &values)
  {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
  }

  const Eigen::VectorXd truth     = constants({2.75, 0.9, 1.62, 0.3, 0.5, 3}),
                        far_start = constants({2, 1.4, 2.5, 0.5, 0.8, 2});
} // namespace

TEST_CASE("least squares: Rosenbrock's valley is followed to its end, with updates as well as without",
          "[optimisation]")
{
  LeastSquaresOptions options;
  options.updated_jacobian  = GENERATE(false, true);
  const LeastSquaresFit fit = least_squares(curve_problem(Eigen::Vector2d(-1.2, 1), rosenbrock, 1e-6), options);
  INFO(fit.ending);
  CHECK(fit.converged);
  CHECK(std::fabs(fit.place[0] - 1) < 1e-6);
  CHECK(std::fabs(fit.place[1] - 1) < 1e-6);
}

TEST_CASE("least squares: a solution on a bound lies on it, and no place beyond is evaluated", "[optimisation]")
{
  bool       outside = false;
  const auto watched = [&outside](const Eigen::VectorXd &x) {
    outside = outside || x[0] > 0.5 || x[1] < -2;
    return rosenbrock(x);
  };
  LeastSquaresProblem problem = curve_problem(Eigen::Vector2d(-1.2, 1), watched, 1e-4);
  problem.upper[0]            = 0.5;
  problem.lower[1]            = -2;
  LeastSquaresOptions options;
  options.central_differences = true;
  const LeastSquaresFit fit   = least_squares(problem, options);
  CHECK_FALSE(outside);
  CHECK(fit.place[0] == 0.5);
  CHECK(fit.place[1] == Approx(0.25).epsilon(1e-6));
  CHECK(fit.jacobian(0, 0) == Approx(-1).epsilon(1e-6)); // one-sided there
}

TEST_CASE("least squares: places without an answer shorten the step and do not end the search", "[optimisation]")
{
  int        requested = 0;
  const auto broken    = [&requested](const Eigen::VectorXd &x) -> std::optional<Eigen::VectorXd> {
    if (x[1] < 0.2 && ++requested) // cuts the first step off
      return std::nullopt;
    return rosenbrock(x);
  };
  const LeastSquaresFit fit = least_squares(curve_problem(Eigen::Vector2d(-1.2, 1), broken, 1e-6), {});
  CHECK(fit.failed == requested);
  CHECK(requested > 0);
  CHECK(fit.sum_of_squares() < rosenbrock(Eigen::Vector2d(-1.2, 1))->squaredNorm() / 2);
}

TEST_CASE("least squares: six constants of two curves with two percent of noise are found within three standard errors",
          "[optimisation]")
{
  std::mt19937               stream(3);
  std::normal_distribution<> noise(0, 0.02);
  Eigen::VectorXd            observed = curves(truth);
  for (double &stress : observed)
    stress *= 1 + noise(stream);
  LeastSquaresOptions options;
  options.central_differences = true;
  const LeastSquaresFit fit   = least_squares(
      curve_problem(
        far_start, [&observed](const Eigen::VectorXd &c) { return std::optional<Eigen::VectorXd>(curves(c) - observed); },
        1e-5),
      options);
  const Eigen::MatrixXd covariance =
    (fit.jacobian.transpose() * fit.jacobian).inverse() * fit.sum_of_squares() / (100 - 6);
  for (int k = 0; k < 6; ++k)
    {
      INFO(k << ": " << fit.place[k] << " for " << truth[k]);
      CHECK(std::fabs(fit.place[k] - truth[k]) < 3 * std::sqrt(covariance(k, k)));
    }
}

TEST_CASE("least squares: updates take fewer evaluations than differences alone, and neither repeats a place",
          "[optimisation]")
{
  const Eigen::VectorXd        observed = curves(truth);
  std::vector<Eigen::VectorXd> places;
  const auto                   model = [&](const Eigen::VectorXd &c) {
    CHECK(std::find(places.begin(), places.end(), c) == places.end());
    places.push_back(c);
    return std::optional<Eigen::VectorXd>(curves(c) - observed);
  };
  LeastSquaresOptions options;
  options.smallest_sum = 1e-4 * observed.squaredNorm();
  const int plain      = least_squares(curve_problem(far_start, model, 1e-5), options).evaluations;
  CHECK(int(places.size()) == plain);
  places.clear();
  options.updated_jacobian = true;
  const int updated        = least_squares(curve_problem(far_start, model, 1e-5), options).evaluations;
  INFO(updated << " against " << plain);
  CHECK(updated < plain);
}

TEST_CASE("least squares: in noise it ends where steps become much shorter than those of the differences",
          "[optimisation]")
{
  // As many residuals as variables, each with a ripple of a thousandth that no step can follow.
  optimisation::LeastSquaresProblem problem;
  problem.start     = Eigen::Vector2d(2, 3);
  problem.lower     = Eigen::Vector2d(0, 0);
  problem.upper     = Eigen::Vector2d(10, 10);
  problem.steps     = Eigen::Vector2d(0.3, 0.3);
  problem.residuals = [](const std::vector<Eigen::VectorXd> &places) {
    std::vector<std::optional<Eigen::VectorXd>> all;
    for (const Eigen::VectorXd &x : places)
      all.push_back(Eigen::Vector2d(x[0] * x[0] - x[1] - 11 + 1e-3 * std::sin(1e9 * x[0]) + 2e-3,
                                    x[0] + x[1] - 8 + 1e-3 * std::sin(1e9 * x[1]) + 2e-3));
    return all;
  };
  optimisation::LeastSquaresOptions options;
  options.updated_jacobian  = true;
  options.smallest_decrease = 0.01;
  options.most_evaluations  = 500;
  options.smallest_step     = 1.0 / 30;
  const auto fit            = optimisation::least_squares(problem, options);
  CHECK(fit.evaluations < 60);
  CHECK(fit.place[0] == Approx(3.887).margin(0.02)); // x^2 + x = 19
  options.smallest_step = 0;
  CHECK(optimisation::least_squares(problem, options).evaluations > fit.evaluations);
}

TEST_CASE("least squares: what cannot be searched is refused", "[optimisation]")
{
  LeastSquaresProblem outside = curve_problem(Eigen::Vector2d(-1.2, 1), rosenbrock, 1e-6);
  outside.lower[0]            = 0;
  CHECK_THROWS_AS(least_squares(outside, {}), base::InputError);
  const auto none = [](const Eigen::VectorXd &) { return std::optional<Eigen::VectorXd>(); };
  CHECK_THROWS_AS(least_squares(curve_problem(Eigen::Vector2d(0, 0), none, 1), {}), base::InputError);
  const auto one = [](const Eigen::VectorXd &) { return std::optional<Eigen::VectorXd>(Eigen::VectorXd::Ones(1)); };
  CHECK_THROWS_AS(least_squares(curve_problem(Eigen::Vector2d(0, 0), one, 1), {}), base::InputError);
}
