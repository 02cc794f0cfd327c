#include "apps/optimisation/direct_search.h"

#include "base/errors.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace optimisation;

namespace
{
  using Model = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd &)>;

  LeastSquaresProblem problem_of(const Eigen::VectorXd &start, const Model &model, const double step)
  {
    const auto one_by_one = [model](const std::vector<Eigen::VectorXd> &places) {
      std::vector<std::optional<Eigen::VectorXd>> all;
      for (const Eigen::VectorXd &place : places)
        all.push_back(model(place));
      return all;
    };
    const Eigen::Index n = start.size();
    return {start,
            Eigen::VectorXd::Constant(n, -3),
            Eigen::VectorXd::Constant(n, 3),
            Eigen::VectorXd::Constant(n, step),
            one_by_one,
            {}};
  }

  /** A bowl with its least value at (1, -0.5), and ripples as the breaking of links makes them: the same at the same place. */
  Eigen::VectorXd rippled(const Eigen::VectorXd &x)
  {
    const double ripple = 0.02 * std::sin(300 * x[0] + 700 * x[1]);
    return Eigen::Vector3d(x[0] - 1 + ripple, 2 * (x[1] + 0.5) - ripple, 0.3 * (x[0] + x[1] - 0.5) + ripple);
  }
} // namespace

TEST_CASE("search without derivatives: where ripples mislead differences it comes near the bottom", "[optimisation]")
{
  LeastSquaresOptions   options;
  const LeastSquaresFit by_differences =
    least_squares(problem_of(Eigen::Vector2d(-2, 2), rippled, 1e-3), options); // slopes of ripples, not of the bowl
  const LeastSquaresFit fit = direct_search(problem_of(Eigen::Vector2d(-2, 2), rippled, 0.1), options);
  INFO(fit.ending << ", " << fit.evaluations << " evaluations, sum " << fit.sum_of_squares() << "; by differences "
                  << by_differences.sum_of_squares());
  CHECK(fit.converged);
  CHECK((fit.place - Eigen::Vector2d(1, -0.5)).norm() < 0.05);
  CHECK(fit.sum_of_squares() < 0.1 * by_differences.sum_of_squares());
  CHECK(fit.evaluations < 300);
  CHECK(fit.jacobian.rows() == 3);
}

TEST_CASE("search without derivatives: a smooth valley is followed, and a bound is not crossed", "[optimisation]")
{
  bool       outside = false;
  const auto valley  = [&outside](const Eigen::VectorXd &x) {
    outside = outside || x[0] > 0.5;
    return Eigen::VectorXd(Eigen::Vector2d(1 - x[0], 10 * (x[1] - x[0] * x[0])));
  };
  LeastSquaresProblem problem = problem_of(Eigen::Vector2d(-1.2, 1), valley, 1e-4);
  LeastSquaresOptions options;
  options.most_evaluations       = 5000;
  problem.upper[0]               = 0.5;
  const LeastSquaresFit at_bound = direct_search(problem, options);
  CHECK_FALSE(outside);
  CHECK(at_bound.place[0] == Approx(0.5).margin(1e-4));
  CHECK(at_bound.place[1] == Approx(0.25).margin(1e-3));
}

TEST_CASE("search without derivatives: places without an answer do not end it, and it ends on request",
          "[optimisation]")
{
  const auto half = [](const Eigen::VectorXd &x) -> std::optional<Eigen::VectorXd> {
    return x[0] > 1.2 ? std::nullopt : std::optional<Eigen::VectorXd>(rippled(x));
  };
  LeastSquaresOptions   options;
  const LeastSquaresFit fit = direct_search(problem_of(Eigen::Vector2d(-2, 2), half, 0.5), options);
  CHECK(fit.failed > 0);
  CHECK((fit.place - Eigen::Vector2d(1, -0.5)).norm() < 0.2);
  options.most_evaluations = 10;
  CHECK(direct_search(problem_of(Eigen::Vector2d(-2, 2), half, 0.5), options).evaluations <=
        10 + 4); // and differences, up or down
  options.most_evaluations    = 1000;
  options.smallest_sum        = 1;
  const LeastSquaresFit early = direct_search(problem_of(Eigen::Vector2d(-2, 2), half, 0.5), options);
  CHECK(early.sum_of_squares() <= 1);
  CHECK(early.evaluations < fit.evaluations);
  LeastSquaresProblem endless = problem_of(Eigen::Vector2d(-2, 2), half, 0.5);
  endless.upper[0]            = INFINITY;
  CHECK_THROWS_AS(direct_search(endless, options), base::InputError);
}

TEST_CASE("least squares: begun with the Jacobian of a cheaper model, it needs fewer evaluations", "[optimisation]")
{
  const auto model = [](const double stiffer) {
    return [stiffer](const Eigen::VectorXd &x) -> std::optional<Eigen::VectorXd> {
      Eigen::VectorXd residuals(4);
      for (int k = 0; k < 4; ++k)
        residuals[k] = stiffer * (1 + 0.5 * x[0]) * std::exp(-0.5 * k * (1 + 0.3 * x[1])) - std::exp(-0.4 * k);
      return residuals;
    };
  };
  LeastSquaresOptions options;
  options.updated_jacobian        = true;
  options.smallest_decrease       = 1e-4;
  LeastSquaresProblem   problem   = problem_of(Eigen::Vector2d(1, 1), model(1.1), 0.01);
  const LeastSquaresFit cheap     = least_squares(problem, options);
  problem.residuals               = problem_of(Eigen::Vector2d(1, 1), model(1.0), 0.01).residuals;
  const LeastSquaresFit alone     = least_squares(problem, options);
  problem.start                   = cheap.place;
  problem.first_jacobian          = cheap.jacobian;
  const LeastSquaresFit following = least_squares(problem, options);
  INFO(alone.evaluations << " alone, " << following.evaluations << " following");
  CHECK((following.place - alone.place).norm() < 1e-2);
  CHECK(following.evaluations < alone.evaluations);
}
