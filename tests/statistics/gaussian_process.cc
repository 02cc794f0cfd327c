#include "apps/statistics/gaussian_process.h"

#include "apps/statistics/space_filling.h"
#include "base/errors.h"
#include "tests/statistics/published_table.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace statistics;

namespace
{
  std::vector<Factor> modulus_factors()
  {
    return PublishedTable("concrete_modulus.csv").factors({"Ec_GPa", "kn_ks", "mu", "Ecj_GPa", "kn_ks_j"});
  }

  Eigen::VectorXd modulus() { return PublishedTable("concrete_modulus.csv").column("E_GPa"); }

  Eigen::VectorXd place(const std::vector<double> &values)
  {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
  }

  GaussianProcess::Shape given_shape() { return {place({2, 1.5, 4, 3, 5}), 1e-3}; }
} // namespace

TEST_CASE("Gaussian process: of a given shape it is that of another program", "[statistics]")
{
  // numpy for the likelihood; scikit-learn 1.2 with the variance of the process, and a constant kernel of 1e7 for the unknown mean.
  const GaussianProcess process(modulus_factors(), modulus(), given_shape());
  CHECK(process.log_likelihood() == Approx(-92.07674353852552).epsilon(1e-10));
  CHECK(process.mean() == Approx(30.26136507070447).epsilon(1e-10));
  CHECK(process.process_variance() == Approx(172.65022089554068).epsilon(1e-10));
  const std::vector<std::vector<double>> points = {{20, 2.5, 1, 10, 2.5}, {12, 1.2, 0.6, 14, 3.9}, {30, 4, 1.5, 15, 4}};
  const std::vector<double>              means  = {34.42637484706938, 25.440522814169526, 44.41934527270496};
  const std::vector<double>              errors = {0.16575597766379044, 1.384004976499858, 2.1476823524347304};
  for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Predicted predicted = process.at(place(points[k]));
      CHECK(predicted.mean == Approx(means[k]).epsilon(1e-6));
      CHECK(predicted.standard_error == Approx(errors[k]).epsilon(2e-5));
    }
}

TEST_CASE("Gaussian process: leave-one-out is the process of the other runs", "[statistics]")
{
  // numpy, the mean estimated anew without the run.
  const Eigen::VectorXd left_out = GaussianProcess(modulus_factors(), modulus(), given_shape()).left_out();
  CHECK(left_out[0] == Approx(19.074164196355202).epsilon(1e-10));
  CHECK(left_out[1] == Approx(32.85088075155746).epsilon(1e-10));
  CHECK(left_out[2] == Approx(42.08071924647172).epsilon(1e-10));
}

TEST_CASE("Gaussian process: its likelihood is as great as another program finds", "[statistics]")
{
  // scipy 1.10, L-BFGS-B from nine starts: -72.72053406, lengths 3.395, 3.855, 50 (bound), 6.81, 50 (bound).
  const GaussianProcess process(modulus_factors(), modulus());
  CHECK(process.log_likelihood() > -72.7205342);
  CHECK(process.shape().lengths[0] == Approx(3.395).epsilon(2e-3));
  CHECK(process.shape().lengths[1] == Approx(3.855).epsilon(2e-3));
  CHECK(process.shape().scatter == Approx(2.729e-4).epsilon(2e-3));
}

TEST_CASE("Gaussian process: a curved response is predicted between its runs, and less surely far from them",
          "[statistics]")
{
  const Eigen::MatrixXd points = latin_hypercube(60, 2, 5);
  std::vector<Factor>   factors{{"a", 10 * points.col(0)}, {"b", 3 + points.col(1).array()}};
  const auto            law = [](const double a, const double b) { return std::sin(a / 2) * b + std::exp(-b) * a; };
  Eigen::VectorXd       response(60);
  for (int run = 0; run < 60; ++run)
    response[run] = law(factors[0].values[run], factors[1].values[run]);
  const GaussianProcess process(factors, response);
  double                worst = 0;
  for (double a = 1; a < 9.5; a += 0.5)
    for (double b = 3.1; b < 3.95; b += 0.1)
      worst = std::max(worst, std::fabs(process.at(place({a, b})).mean - law(a, b)));
  CHECK(worst < 0.01);
  CHECK(process.at(place({14, 3.5})).standard_error > 5 * process.at(place({5, 3.5})).standard_error);
  for (int run = 0; run < 60; ++run)
    CHECK(process.at(place({factors[0].values[run], factors[1].values[run]})).mean ==
          Approx(response[run]).margin(1e-3));
}

TEST_CASE("Gaussian process: scatter of runs is distinguished from the surface, which is more certain than a run",
          "[statistics]")
{
  const Eigen::MatrixXd            points = latin_hypercube(80, 1, 9);
  std::mt19937                     stream(1);
  std::normal_distribution<double> noise(0, 0.2);
  Eigen::VectorXd                  response(80);
  for (int run = 0; run < 80; ++run)
    response[run] = std::cos(6 * points(run, 0)) + noise(stream);
  const GaussianProcess process({{"a", points.col(0)}}, response);
  const double          scatter = std::sqrt(process.shape().scatter * process.process_variance());
  CHECK(scatter == Approx(0.2).epsilon(0.2));
  CHECK(process.at(place({0.5})).standard_error < scatter / 2);
  int inside = 0;
  for (double a = 0.025; a < 1; a += 0.05)
    {
      const Predicted predicted = process.at(place({a}));
      inside += std::fabs(predicted.mean - std::cos(6 * a)) < 2.5 * predicted.standard_error;
    }
  CHECK(inside >= 18); // of 20
}

TEST_CASE("Gaussian process: too many runs, and responses and factors that stand still, are refused", "[statistics]")
{
  CHECK_THROWS_WITH(
    GaussianProcess({{"a", Eigen::VectorXd::LinSpaced(301, 0, 1)}}, Eigen::VectorXd::LinSpaced(301, 0, 1)),
    Catch::Contains("301 runs"));
  CHECK_THROWS_WITH(GaussianProcess({{"a", Eigen::VectorXd::Ones(9)}}, Eigen::VectorXd::LinSpaced(9, 0, 1)),
                    Catch::Contains("factor a"));
  CHECK_THROWS_WITH(GaussianProcess({{"a", Eigen::VectorXd::LinSpaced(9, 0, 1)}}, Eigen::VectorXd::Ones(9)),
                    Catch::Contains("does not vary"));
}
