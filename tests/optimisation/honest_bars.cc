#include "apps/optimisation/least_squares_search.h"
#include "apps/optimisation/model_noise.h"
#include "apps/optimisation/synthetic_calibrations.h"
#include "apps/statistics/uncertainty.h"
#include "base/errors.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

using optimisation::softening_stresses;

namespace
{
  optimisation::LeastSquaresFit
  fitted(const Eigen::VectorXd &observed, const Eigen::VectorXd &start, const double deviation)
  {
    optimisation::LeastSquaresProblem problem;
    problem.start     = start;
    problem.lower     = Eigen::Vector3d(0.1, 0.1, 0.3);
    problem.upper     = Eigen::Vector3d(50, 10, 10);
    problem.steps     = Eigen::Vector3d::Constant(1e-5);
    problem.residuals = [&observed, deviation](const std::vector<Eigen::VectorXd> &places) {
      std::vector<std::optional<Eigen::VectorXd>> all;
      for (const Eigen::VectorXd &place : places)
        all.emplace_back((softening_stresses(place) - observed) / deviation);
      return all;
    };
    optimisation::LeastSquaresOptions options;
    options.central_differences = true;
    return optimisation::least_squares(problem, options);
  }
} // namespace

TEST_CASE(
  "uncertainty: over 1000 calibrations the truth lies inside the band of 95 percent in 92 to 98 percent of cases",
  "[optimisation]")
{
  const Eigen::VectorXd      truth = Eigen::Vector3d(3, 1, 2), ranges = Eigen::Vector3d(10, 3, 5);
  const bool                 known        = GENERATE(true, false); // whether the scatter of observations is known
  constexpr int              calibrations = 1000;
  constexpr double           deviation    = 0.05;
  std::mt19937               stream(38);
  std::normal_distribution<> noise(0, deviation);
  Eigen::Vector3i            inside      = Eigen::Vector3i::Zero();
  int                        peak_inside = 0;
  for (int calibration = 0; calibration < calibrations; ++calibration)
    {
      Eigen::VectorXd observed = softening_stresses(truth);
      for (double &stress : observed)
        stress += noise(stream);
      const auto fit  = fitted(observed, Eigen::Vector3d(2, 1.5, 1.5), deviation);
      const auto sure = statistics::uncertainty(fit.jacobian, fit.residuals, ranges, {{}, known ? 1.0 : 0.0});
      REQUIRE(sure.undetermined.empty());
      for (int k = 0; k < 3; ++k)
        inside[k] += std::fabs(fit.place[k] - truth[k]) < sure.half_width(k, 0.95);
      constexpr int at = 6; // a predicted stress, too
      peak_inside += std::fabs(softening_stresses(fit.place)[at] - softening_stresses(truth)[at]) <
                     deviation * sure.half_width_of(fit.jacobian.row(at).transpose(), 0.95);
    }
  for (int k = 0; k < 3; ++k)
    {
      INFO("constant " << k + 1 << (known ? ", scatter known" : ", scatter estimated"));
      CHECK(inside[k] >= 0.92 * calibrations);
      CHECK(inside[k] <= 0.98 * calibrations);
    }
  CHECK(peak_inside >= 0.92 * calibrations);
  CHECK(peak_inside <= 0.98 * calibrations);
}

TEST_CASE(
  "uncertainty: with what is done by default, 95 percent of bands hold the truth, of smooth models and of rough ones",
  "[optimisation]")
{
  const double                        scatter = GENERATE(0.0, 0.005, 0.02);
  const bool                          known   = GENERATE(true, false);
  optimisation::SyntheticCalibrations requested;
  requested.model_scatter = scatter;
  requested.known         = known;
  const auto found        = optimisation::coverage_of(requested);
  INFO("scatter " << scatter << (known ? ", deviation known" : ", deviation estimated") << ", rough " << found.rough);
  for (int k = 0; k < 3; ++k)
    {
      INFO("constant " << k + 1);
      CHECK(found.inside[k] >= 0.92 * requested.count);
      CHECK(found.inside[k] <= 0.98 * requested.count);
      if (known && scatter == 0.02)
        CHECK(found.by_residuals[k] < 0.5 * requested.count);
    }
  if (scatter == 0)
    CHECK(found.rough == 0);
}

TEST_CASE("noise of a model: a constant on its bound stays there and costs no run", "[optimisation]")
{
  optimisation::LeastSquaresProblem problem;
  problem.start     = Eigen::Vector3d(0.4, 0.5, 0.6);
  problem.lower     = Eigen::Vector3d(0, 0.5, 0); // the second would be below
  problem.upper     = Eigen::Vector3d(1, 1, 1);
  problem.steps     = Eigen::Vector3d::Constant(0.03);
  problem.residuals = [](const std::vector<Eigen::VectorXd> &places) {
    std::vector<std::optional<Eigen::VectorXd>> all;
    for (const Eigen::VectorXd &place : places)
      {
        Eigen::VectorXd residuals(6);
        for (int k = 0; k < 6; ++k)
          residuals[k] = (place - Eigen::Vector3d(0.3, 0.2, 0.7)).dot(Eigen::Vector3d(1, k, k * k)) +
                         0.01 * std::sin(1e4 * (k + 1) * place.sum());
        all.emplace_back(residuals);
      }
    return all;
  };
  const auto                    fit = optimisation::least_squares(problem, {});
  std::set<double>              seconds;
  const optimisation::Residuals residuals = problem.residuals;
  problem.residuals                       = [&](const std::vector<Eigen::VectorXd> &places) {
    for (const Eigen::VectorXd &place : places)
      seconds.insert(place[1]);
    return residuals(places);
  };
  REQUIRE(fit.place[1] == 0.5);
  optimisation::NoiseOptions always;
  always.search     = optimisation::NoiseSearch::always;
  always.wide_steps = Eigen::Vector3d::Constant(0.06);
  const auto end    = optimisation::model_at_end(problem, {}, fit, always);
  CHECK(seconds == std::set<double>{0.5});
  CHECK(end.jacobian.col(1).isZero(0));
  CHECK(end.jacobian.col(0).norm() > 1);
  CHECK(end.evaluations <=
        4 + 4 * (4 + 5) + 1); // a line, at most four times central differences and a line, the answer
}

namespace
{
  /** Far from its start, and rough; the sum of squares is least at 0.7, 0.6. */
  optimisation::LeastSquaresProblem rough_planes()
  {
    optimisation::LeastSquaresProblem problem;
    problem.start     = Eigen::Vector2d(0.2, 0.2);
    problem.lower     = Eigen::Vector2d::Zero();
    problem.upper     = Eigen::Vector2d::Ones();
    problem.steps     = Eigen::Vector2d::Constant(0.03);
    problem.residuals = [](const std::vector<Eigen::VectorXd> &places) {
      std::vector<std::optional<Eigen::VectorXd>> all;
      for (const Eigen::VectorXd &place : places)
        all.emplace_back(Eigen::Vector4d(place[0] - 0.7, place[1] - 0.6, place.sum() - 1.3, place[0] - place[1] - 0.1) +
                         0.01 * (1e4 * Eigen::Vector4d(1, 2, 3, 4) * place.sum()).array().sin().matrix());
      return all;
    };
    return problem;
  }

  /** As if a search had ended at its start. */
  optimisation::LeastSquaresFit ended_at_start(const optimisation::LeastSquaresProblem &problem)
  {
    optimisation::LeastSquaresFit there;
    there.place     = problem.start;
    there.residuals = *problem.residuals({problem.start}).front();
    return there;
  }

  optimisation::NoiseOptions noise_wanted()
  {
    optimisation::NoiseOptions noise;
    noise.search     = optimisation::NoiseSearch::always;
    noise.wide_steps = Eigen::Vector2d::Constant(0.06);
    return noise;
  }

  constexpr int on_a_line = 4, in_a_round = 2 * 2 + 5, answer = 1; // evaluations of two variables
} // namespace

TEST_CASE("noise of a model: derivatives are taken anew only where evaluations are left, and it says so",
          "[optimisation]")
{
  const auto                 problem = rough_planes();
  const auto                 there   = ended_at_start(problem);
  optimisation::NoiseOptions noise   = noise_wanted();
  const auto                 free    = optimisation::model_at_end(problem, {}, there, noise);
  CHECK_FALSE(free.cut_short);
  CHECK(free.evaluations > on_a_line + 2 * in_a_round);
  noise.most_evaluations = on_a_line + 2 * in_a_round + answer;
  const auto two         = optimisation::model_at_end(problem, {}, there, noise);
  CHECK(two.cut_short);
  CHECK(two.evaluations == noise.most_evaluations);
  --noise.most_evaluations;
  const auto one = optimisation::model_at_end(problem, {}, there, noise);
  CHECK(one.cut_short);
  CHECK(one.evaluations == on_a_line + in_a_round + answer);
  CHECK(one.noise.cols() > 0);
}

TEST_CASE("noise of a model: derivatives are not taken anew within what constants are known to", "[optimisation]")
{
  // Standard errors of these planes: the deviation over the root of three, along each variable. Steps are at most two wide ones, 0.12.
  const auto                 problem = rough_planes();
  const auto                 there   = ended_at_start(problem);
  optimisation::NoiseOptions noise   = noise_wanted();
  noise.deviation                    = 0.13 * std::sqrt(3.0);
  const auto unsure                  = optimisation::model_at_end(problem, {}, there, noise);
  CHECK(unsure.evaluations == on_a_line + in_a_round + answer);
  CHECK_FALSE(unsure.cut_short);
  noise.deviation = 0.08 * std::sqrt(3.0);
  CHECK(optimisation::model_at_end(problem, {}, there, noise).evaluations > on_a_line + 2 * in_a_round);
}

TEST_CASE("noise of a model: an answer that is worse by more than noise explains is not taken", "[optimisation]")
{
  // At the kink of the first residual, which differences to both sides do not see; the second one leads away from there.
  optimisation::LeastSquaresProblem problem;
  problem.start     = Eigen::VectorXd::Constant(1, 0.5);
  problem.lower     = Eigen::VectorXd::Zero(1);
  problem.upper     = Eigen::VectorXd::Ones(1);
  problem.steps     = Eigen::VectorXd::Constant(1, 0.03);
  problem.residuals = [](const std::vector<Eigen::VectorXd> &places) {
    std::vector<std::optional<Eigen::VectorXd>> all;
    for (const Eigen::VectorXd &place : places)
      {
        const double way = place[0] - 0.5, rough = 0.003 * std::sin(1e4 * place[0]);
        all.emplace_back(Eigen::Vector2d(1.5 * std::fabs(way) + rough, 0.3 - way - rough));
      }
    return all;
  };
  const auto                 there = ended_at_start(problem);
  optimisation::NoiseOptions noise = noise_wanted();
  noise.wide_steps                 = Eigen::VectorXd::Constant(1, 0.06);
  noise.most_evaluations           = 4 + 7 + 1; // a line, a round of one variable, the answer
  const auto end                   = optimisation::model_at_end(problem, {}, there, noise);
  CHECK(end.place == problem.start); // squares of 0.133 where it would have led, 0.09 here
  CHECK(end.residuals == there.residuals);
  CHECK(end.share == 1);
  CHECK(end.leads_astray);
  CHECK(end.jacobian(0, 0) == Approx(0).margin(0.1));
  CHECK(end.jacobian(1, 0) == Approx(-1).margin(0.1));
  CHECK_FALSE(end.cut_short);
}

TEST_CASE("noise of a model: whoever holds a variable for what the first derivatives show runs no more",
          "[optimisation]")
{
  const auto                 problem = rough_planes();
  const auto                 there   = ended_at_start(problem);
  optimisation::NoiseOptions noise   = noise_wanted();
  int                        asked   = 0;
  noise.goes_on                      = [&](const optimisation::ModelAtEnd &so_far) {
    ++asked;
    CHECK(so_far.evaluations == on_a_line + 2 * 2);
    CHECK(so_far.jacobian(2, 0) == Approx(1).margin(0.3)); // of the third plane, but for noise of 0.01 over 0.12
    CHECK(so_far.noise.cols() > 0);
    return false;
  };
  const auto end = optimisation::model_at_end(problem, {}, there, noise);
  CHECK(asked == 1);
  CHECK(end.evaluations == on_a_line + 2 * 2);
  CHECK(end.place == problem.start);
  noise.goes_on = [&](const optimisation::ModelAtEnd &) { return ++asked > 1; };
  CHECK(optimisation::model_at_end(problem, {}, there, noise).evaluations > on_a_line + 2 * in_a_round);
  CHECK(asked == 2);
}

TEST_CASE("uncertainty: standard errors of a straight line are those of the textbook", "[optimisation]")
{
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 1, 5);
  Eigen::MatrixXd       jacobian(5, 2);
  jacobian << Eigen::VectorXd::Ones(5), x;
  Eigen::VectorXd residuals(5);
  residuals << 0.1, -0.2, 0.1, 0.05, -0.05;
  const auto   sure = statistics::uncertainty(jacobian, residuals, Eigen::Vector2d(1, 10));
  const double s    = std::sqrt(residuals.squaredNorm() / 3);
  CHECK(sure.scatter == Approx(s).epsilon(1e-14));
  CHECK(sure.standard_errors[1] == Approx(s / std::sqrt(10.0)).epsilon(1e-12));               // Sxx = 10
  CHECK(sure.standard_errors[0] == Approx(s * std::sqrt(1.0 / 5 + 9.0 / 10)).epsilon(1e-12)); // mean 3
  CHECK(sure.correlation(0, 1) == Approx(-3 / std::sqrt(11.0)).epsilon(1e-12));
  CHECK(sure.half_width(1, 0.95) == Approx(3.182446305 * s / std::sqrt(10.0)).epsilon(1e-9)); // t of 3 degrees
}

TEST_CASE("uncertainty: a constant that the data do not determine is taken out, and the others stay", "[optimisation]")
{
  std::srand(1); // Eigen draws from it
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Random(20, 3);
  jacobian.col(2)          = 2 * jacobian.col(0); // only a sum of the first and the third is seen
  jacobian.col(2) *= 0.1;                         // by the third, less
  const Eigen::VectorXd residuals = Eigen::VectorXd::Random(20);
  const auto            sure      = statistics::uncertainty(jacobian, residuals, Eigen::Vector3d(1, 1, 1));
  CHECK(sure.undetermined == std::vector<int>{2});
  CHECK(std::isnan(sure.standard_errors[2]));
  CHECK(sure.condition < 100);
  const auto without = statistics::uncertainty(jacobian.leftCols(2), residuals, Eigen::Vector2d(1, 1));
  CHECK(sure.standard_errors.head(2).isApprox(without.standard_errors, 1e-12));
  jacobian.col(1).setZero(); // of which nothing is seen at all
  CHECK(statistics::uncertainty(jacobian, residuals, Eigen::Vector3d(1, 1, 1)).undetermined == std::vector<int>{1, 2});
}

TEST_CASE("uncertainty: as many residuals as constants have no scatter, unless that is known", "[optimisation]")
{
  const Eigen::MatrixXd jacobian = Eigen::Matrix2d::Identity();
  const Eigen::VectorXd none     = Eigen::Vector2d::Zero();
  CHECK_THROWS_AS(statistics::uncertainty(jacobian, none, Eigen::Vector2d(1, 1)), base::InputError);
  const auto sure = statistics::uncertainty(jacobian, none, Eigen::Vector2d(1, 1), {{}, 0.5});
  CHECK(sure.standard_errors[0] == Approx(0.5));
  CHECK(sure.half_width(0, 0.95) == Approx(0.5 * 1.959963985).epsilon(1e-8));
}
