#include "apps/statistics/response_surface.h"
#include "base/errors.h"
#include "tests/statistics/published_table.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace statistics;

namespace
{
  const std::vector<std::string> of_strength = {"sigc_MPa", "tauc_MPa"};
  const std::vector<std::string> of_modulus  = {"Ec_GPa", "kn_ks", "mu", "Ecj_GPa", "kn_ks_j"};

  ResponseSurface strength_surface()
  {
    const PublishedTable table("concrete_strength.csv");
    return fit_surface(table.factors(of_strength), table.column("sigma_u_MPa"), Degree::quadratic);
  }

  ResponseSurface modulus_surface()
  {
    const PublishedTable table("concrete_modulus.csv");
    return fit_surface(table.factors(of_modulus), table.column("E_GPa"), Degree::quadratic);
  }

  /** The equations as they were printed, rounded. */
  ResponseSurface printed_strength()
  {
    ResponseSurface surface = strength_surface();
    surface.coefficients << -0.48, 1.083, 0.919, -0.03138, -0.03018, 0.06602;
    return surface;
  }

  ResponseSurface printed_modulus()
  {
    ResponseSurface surface = modulus_surface();
    surface.coefficients << 0.3, 1.998, -3.647, 4.71, 0.715, -0.396, -0.00771, 0.7972, -1.959, -0.0342, 0.0129, -0.1492,
      0.0491, 0.02473, -0.0286, -0.388, -0.0611, 0.064, 0.01, 0.155, 0.0158;
    return surface;
  }

  /** To half a unit of the last digit that is given. */
  void check_coefficients(const ResponseSurface &surface, const std::vector<double> &published, const double margin)
  {
    REQUIRE(surface.coefficients.size() == Eigen::Index(published.size()));
    const std::vector<std::string> names = surface.polynomial.term_names();
    for (std::size_t term = 0; term < published.size(); ++term)
      {
        INFO(names[term]);
        CHECK(std::fabs(surface.coefficients[term] - published[term]) < margin);
      }
  }

  Eigen::VectorXd point(std::initializer_list<double> values)
  {
    Eigen::VectorXd vector(values.size());
    std::copy(values.begin(), values.end(), vector.begin());
    return vector;
  }
} // namespace

TEST_CASE("surfaces: the terms of a quadratic one are named by powers and products", "[statistics]")
{
  CHECK(Polynomial::quadratic({"A", "B"}).term_names() == std::vector<std::string>{"1", "A", "B", "A^2", "B^2", "A*B"});
  CHECK(Polynomial::linear({"A", "B"}).term_names() == std::vector<std::string>{"1", "A", "B"});
  CHECK(Polynomial::quadratic(of_modulus).size() == 21);
}

TEST_CASE("surfaces: linear regressions of the orthogonal design of concrete", "[statistics]")
{
  const PublishedTable  table("concrete_orthogonal.csv");
  const ResponseSurface strength = fit_surface(table.factors(of_strength), table.column("sigma_u_MPa"), Degree::linear);
  check_coefficients(strength, {1.6015483, 0.83521023, 0.77971023}, 6e-8);
  CHECK(strength.fit.r_squared() == Approx(0.759859).margin(5e-7));
  const ResponseSurface modulus = fit_surface(table.factors(of_modulus), table.column("E_GPa"), Degree::linear);
  check_coefficients(modulus, {5.15075758, 1.60576136, -3.01477273, 1.69068182, 0.40629545, -0.28143939}, 6e-9);
  CHECK(modulus.fit.r_squared() == Approx(0.977678).margin(5e-7));
  const ResponseSurface poisson =
    fit_surface(table.factors({"Ec_GPa", "kn_ks", "mu", "kn_ks_j"}), table.column("nu"), Degree::linear);
  check_coefficients(poisson, {0.07253741, -0.00109602, 0.08025379, -0.02369318, 0.00423864}, 6e-9);
  CHECK(poisson.fit.r_squared() == Approx(0.938159).margin(5e-7));
}

TEST_CASE("surfaces: what was printed for the strength and for Poisson's ratio does not belong to the runs",
          "[statistics]")
{
  const PublishedTable  table("concrete_orthogonal.csv");
  const Eigen::VectorXd strength = table.column("sigma_u_MPa");
  const Eigen::VectorXd printed =
    (-12.58 + 0.934 * table.column("sigc_MPa").array() + 0.7797 * table.column("tauc_MPa").array()).matrix();
  CHECK((strength - printed).mean() == Approx(12.45).margin(0.005));
  CHECK((strength - printed).squaredNorm() > (strength.array() - strength.mean()).matrix().squaredNorm());
  const Eigen::ArrayXd poisson = -0.0725 - 0.001096 * table.column("Ec_GPa").array() +
                                 0.08025 * table.column("kn_ks").array() - 0.02369 * table.column("mu").array() +
                                 0.00424 * table.column("kn_ks_j").array();
  CHECK((table.column("nu").array() - poisson).mean() == Approx(0.145).margin(5e-4));
}

TEST_CASE("surfaces: the quadratic surface of strength is the published one, with its lack of fit", "[statistics]")
{
  const ResponseSurface surface = strength_surface();
  check_coefficients(surface, {-0.481246, 1.082894, 0.918927, -0.031381, -0.030181, 0.066025}, 6e-7);
  CHECK(surface.fit.r_squared() == Approx(0.98813).margin(5e-6));
  CHECK(surface.fit.adjusted_r_squared() == Approx(0.97965).margin(5e-6));
  CHECK(surface.fit.press_r_squared() == Approx(0.9387).margin(5e-5));
  CHECK(surface.fit.standard_error() == Approx(1.942).margin(5e-4));
  CHECK(surface.fit.error_sum == Approx(26.3992).margin(5e-5));
  CHECK(surface.fit.error_degrees == 7);
  REQUIRE(surface.lack_of_fit);
  CHECK(surface.lack_of_fit->pure_error == Approx(9.2592).margin(5e-5));
  CHECK(surface.lack_of_fit->pure_degrees == 4);
  CHECK(surface.lack_of_fit->lack_degrees == 3);
  CHECK(surface.lack_of_fit->f == Approx(2.468).margin(5e-4));
  CHECK(surface.lack_of_fit->p == Approx(0.20).margin(5e-3));
}

TEST_CASE("surfaces: the quadratic surface of the modulus is the published one, with its lack of fit", "[statistics]")
{
  const ResponseSurface surface = modulus_surface();
  check_coefficients(surface, {0.297188, 1.998448,  -3.647065, 4.709875, 0.715338,  -0.396394, -0.007706,
                               0.797185, -1.959,    -0.034203, 0.012926, -0.149233, 0.0491,    0.024725,
                               -0.0286,  -0.388333, -0.0611,   0.064222, 0.0096,    0.155333,  0.015767},
                     6e-7);
  CHECK(surface.fit.r_squared() == Approx(0.998126).margin(5e-7));
  CHECK(surface.fit.adjusted_r_squared() == Approx(0.996627).margin(5e-7));
  CHECK(surface.fit.press_r_squared() == Approx(0.99527).margin(5e-6));
  CHECK(surface.fit.standard_error() == Approx(0.5756).margin(5e-5));
  CHECK(surface.fit.error_sum == Approx(8.28301).margin(5e-6));
  REQUIRE(surface.lack_of_fit);
  CHECK(surface.lack_of_fit->pure_error == Approx(4.78335).margin(5e-6));
  CHECK(surface.lack_of_fit->pure_degrees == 5);
  CHECK(surface.lack_of_fit->lack_degrees == 20);
  CHECK(surface.lack_of_fit->f == Approx(0.183).margin(5e-4));
  Eigen::Index worst = 0;
  surface.fit.residuals.cwiseAbs().maxCoeff(&worst);
  CHECK(worst == 11); // run 12, a centre point
  CHECK(surface.fit.residuals[worst] == Approx(1.925).margin(5e-4));
}

TEST_CASE("surfaces: the printed equations give the published values, and strengths in their box", "[statistics]")
{
  const ResponseSurface strength = printed_strength(), modulus = printed_modulus();
  CHECK(strength.value(point({20, 20})) == Approx(41.344).margin(5e-4));
  CHECK(strength.value(point({10, 30})) == Approx(27.426).margin(5e-4));
  CHECK(strength.value(point({30, 10})) == Approx(29.746).margin(5e-4));
  CHECK(strength.value(point({10, 10})) == Approx(19.986).margin(5e-4));
  CHECK(strength.value(point({30, 30})) == Approx(63.594).margin(5e-4));
  CHECK(modulus.value(point({20, 2.5, 1, 10, 2.5})) == Approx(34.4356).margin(5e-5));
  CHECK(modulus.value(point({10, 1, 0.5, 5, 1})) == Approx(20.3114).margin(5e-5));
  CHECK(modulus.value(point({30, 4, 1.5, 15, 4})) == Approx(44.9128).margin(5e-5));
  CHECK(strength.box.contains(point({30, 30})));
  CHECK_FALSE(strength.box.contains(point({35, 20})));
}

TEST_CASE("surfaces: the published answers of the inversion are off the printed equations as far as they are",
          "[statistics]")
{
  struct Answer
  {
    Eigen::VectorXd strength, modulus;
    double          target_strength, target_modulus, off_strength, off_modulus; ///< [%]
  };
  const std::vector<Answer> answers = {
    {point({28.7, 27.884}), point({17.522, 1.983, 1.356, 10.236, 2.626}), 59.67, 32.68, 0.13, 0.00},
    {point({18.938, 22.454}), point({13.944, 1.75, 0.83, 10.552, 3.797}), 42.67, 26.78, -0.94, -0.32},
    {point({14.277, 23.109}), point({13.435, 2.0, 0.867, 11.36, 2.205}), 36.54, 25.66, -2.88, -0.01},
    {point({24.447, 21.68}), point({11.013, 1.938, 0.93, 11.622, 2.923}), 47.67, 21.54, 0.63, 0.00},
    {point({26.243, 18.139}), point({12.815, 1.98, 1.292, 11.263, 3.783}), 43.6, 24.67, 2.06, 0.00}};
  const ResponseSurface strength = printed_strength(), modulus = printed_modulus();
  for (const Answer &answer : answers)
    {
      INFO(answer.target_strength << " MPa");
      CHECK(std::fabs(100 * (strength.value(answer.strength) / answer.target_strength - 1) - answer.off_strength) <
            0.0051);
      CHECK(std::fabs(100 * (modulus.value(answer.modulus) / answer.target_modulus - 1) - answer.off_modulus) < 0.0051);
    }
}

TEST_CASE("surfaces: the printed equations predict the runs of the orthogonal design as published", "[statistics]")
{
  const PublishedTable  table("concrete_orthogonal.csv");
  const ResponseSurface strength = printed_strength(), modulus = printed_modulus();
  Eigen::VectorXd       off_strength(64), off_modulus(64);
  for (int run = 0; run < 64; ++run)
    {
      Eigen::VectorXd factors(5);
      for (int factor = 0; factor < 5; ++factor)
        factors[factor] = table.column(of_modulus[factor])[run];
      off_modulus[run]  = modulus.value(factors) - table.column("E_GPa")[run];
      off_strength[run] = strength.value(point({table.column("sigc_MPa")[run], table.column("tauc_MPa")[run]})) -
                          table.column("sigma_u_MPa")[run];
    }
  CHECK(std::sqrt(off_modulus.squaredNorm() / 64) == Approx(0.795).margin(5e-3));
  CHECK(off_modulus.cwiseAbs().maxCoeff() == Approx(4.38).margin(5e-3));
  CHECK(std::sqrt(off_strength.squaredNorm() / 64) == Approx(3.62).margin(5e-3));
  CHECK(off_strength.mean() == Approx(1.83).margin(5e-3));
}

TEST_CASE("surfaces: coefficients from coded variables are those of a direct fit to 1e-9", "[statistics]")
{
  const PublishedTable  table("concrete_modulus.csv");
  const ResponseSurface surface = modulus_surface();
  Eigen::MatrixXd       points(46, 5);
  for (int factor = 0; factor < 5; ++factor)
    points.col(factor) = table.column(of_modulus[factor]);
  const Eigen::MatrixXd matrix = surface.polynomial.matrix(points);
  const Eigen::VectorXd direct = matrix.householderQr().solve(table.column("E_GPa"));
  for (Eigen::Index term = 0; term < direct.size(); ++term)
    CHECK(std::fabs(surface.coefficients[term] / direct[term] - 1) < 1e-9);
  const Eigen::MatrixXd inverse = (matrix.transpose() * matrix).inverse();
  for (Eigen::Index term = 0; term < direct.size(); ++term)
    CHECK(surface.standard_errors[term] ==
          Approx(surface.fit.standard_error() * std::sqrt(inverse(term, term))).epsilon(1e-6));
}

TEST_CASE("surfaces: leave-one-out and studentised residuals are those of fits without the run", "[statistics]")
{
  const PublishedTable      table("concrete_strength.csv");
  const std::vector<Factor> factors = table.factors(of_strength);
  const Eigen::VectorXd     y       = table.column("sigma_u_MPa");
  const ResponseSurface     all     = strength_surface();
  double                    press   = 0;
  for (int run = 0; run < 13; ++run)
    {
      std::vector<int> others;
      for (int other = 0; other < 13; ++other)
        if (other != run)
          others.push_back(other);
      std::vector<Factor> left = factors;
      for (Factor &factor : left)
        factor.values = Eigen::VectorXd(factor.values(others));
      const ResponseSurface without = fit_surface(left, y(others), Degree::quadratic);
      const Eigen::VectorXd where   = point({factors[0].values[run], factors[1].values[run]});
      const double          missed  = y[run] - without.value(where);
      INFO("run " << run + 1);
      CHECK(all.fit.left_out[run] == Approx(without.value(where)).epsilon(1e-8));
      const double prediction_error = without.fit.standard_error() / std::sqrt(1 - all.fit.leverage[run]);
      CHECK(all.fit.studentised[run] == Approx(missed / prediction_error).epsilon(1e-8));
      press += missed * missed;
    }
  CHECK(all.fit.press == Approx(press).epsilon(1e-10));
}

TEST_CASE("surfaces: the gradient is the derivative of the value", "[statistics]")
{
  const ResponseSurface surface  = modulus_surface();
  const Eigen::VectorXd where    = point({17, 1.9, 0.8, 12, 3.1});
  const Eigen::VectorXd gradient = surface.gradient(where);
  for (int factor = 0; factor < 5; ++factor)
    {
      Eigen::VectorXd up = where, down = where;
      up[factor] += 1e-3;
      down[factor] -= 1e-3;
      CHECK(gradient[factor] == Approx((surface.value(up) - surface.value(down)) / 2e-3).epsilon(1e-8));
    }
}

TEST_CASE("surfaces: a polynomial that made the runs is found again, with nothing left to chance", "[statistics]")
{
  std::mt19937        stream(3);
  std::vector<Factor> factors = {{"a", Eigen::VectorXd(20)}, {"b", Eigen::VectorXd(20)}, {"c", Eigen::VectorXd(20)}};
  for (Factor &factor : factors)
    for (double &value : factor.values)
      value = 1e9 + 1e8 * (stream() % 1000);
  const Eigen::ArrayXd  a = factors[0].values.array() / 1e9, b = factors[1].values.array() / 1e9;
  const ResponseSurface surface =
    fit_surface(factors, (3 + 2 * a - b + 0.5 * a * b - 0.25 * b * b).matrix(), Degree::quadratic);
  CHECK(surface.coefficients[0] == Approx(3).epsilon(1e-8));
  CHECK(surface.coefficients[1] * 1e9 == Approx(2).epsilon(1e-8));
  CHECK(surface.coefficients[7] * 1e18 == Approx(0.5).epsilon(1e-8)); // a*b
  CHECK(surface.fit.r_squared() == Approx(1).epsilon(1e-12));
}

TEST_CASE("surfaces: a copied run is no measure of scatter", "[statistics]")
{
  const PublishedTable table("concrete_strength.csv");
  std::vector<Factor>  factors = table.factors(of_strength);
  Eigen::VectorXd      y       = table.column("sigma_u_MPa");
  for (Factor &factor : factors)
    {
      factor.values.conservativeResize(14);
      factor.values[13] = factor.values[4];
    }
  y.conservativeResize(14);
  y[13]                         = y[4];
  const ResponseSurface surface = fit_surface(factors, y, Degree::quadratic, {13});
  REQUIRE(surface.lack_of_fit);
  CHECK(surface.lack_of_fit->pure_degrees == 4);
  CHECK(surface.lack_of_fit->f == Approx(2.468).margin(5e-4));
}

TEST_CASE("surfaces: too few runs, factors that stand still and terms that cannot be distinguished are refused by name",
          "[statistics]")
{
  const PublishedTable table("concrete_strength.csv");
  std::vector<Factor>  factors = table.factors(of_strength);
  Eigen::VectorXd      y       = table.column("sigma_u_MPa");
  std::vector<Factor>  few     = factors;
  for (Factor &factor : few)
    factor.values = Eigen::VectorXd(factor.values.head(5));
  CHECK_THROWS_WITH(fit_surface(few, y.head(5), Degree::quadratic), Catch::Contains("5 runs for 6 terms"));
  std::vector<Factor> still = factors;
  still[1].values.setConstant(20);
  CHECK_THROWS_WITH(fit_surface(still, y, Degree::linear), Catch::Contains("tauc_MPa has the same value"));
  std::vector<Factor> alike = factors;
  alike[1].values           = 3 * alike[0].values;
  CHECK_THROWS_WITH(fit_surface(alike, y, Degree::linear),
                    Catch::Contains("tauc_MPa from sigc_MPa") || Catch::Contains("sigc_MPa from tauc_MPa"));
  CHECK_THROWS_AS(fit_surface(alike, y, Degree::quadratic), base::InputError);
}
