#include "apps/statistics/anova.h"
#include "apps/statistics/distributions.h"
#include "apps/statistics/ranges.h"
#include "base/errors.h"
#include "tests/statistics/published_table.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace statistics;

namespace
{
  const PublishedTable &orthogonal()
  {
    static const PublishedTable table("concrete_orthogonal.csv");
    return table;
  }

  Anova with_null_as_factor(const std::string &response)
  {
    return analyse_variance(orthogonal().factors(orthogonal_columns), orthogonal().column(response));
  }

  double f_of(const Anova &anova, const std::string &factor)
  {
    for (const Effect &effect : anova.effects)
      if (effect.factor == factor)
        return effect.f;
    FAIL("no effect of " << factor);
    return 0;
  }
} // namespace

TEST_CASE("ranges: means of levels and their ranges are those of the published design", "[statistics]")
{
  const auto strength = ranges(orthogonal().factors(orthogonal_columns), orthogonal().column("sigma_u_MPa"));
  CHECK(strength[2].factor == "sigc_MPa");
  CHECK(strength[2].rank == 1);
  CHECK(strength[2].range == Approx(16.188).margin(5e-4));
  CHECK(strength[2].means[0] == Approx(23.0828).margin(5e-5));
  CHECK(strength[2].means[1] == Approx(34.0138).margin(5e-5));
  CHECK(strength[2].means[2] == Approx(39.2713).margin(5e-5));
  CHECK(strength[3].range == Approx(15.141).margin(5e-4));
  CHECK(strength[3].rank == 2);
  CHECK(strength[10].range == Approx(3.782).margin(5e-4)); // sigcj
  CHECK(strength[4].range == Approx(2.620).margin(5e-4));  // mu
  const auto modulus = ranges(orthogonal().factors(orthogonal_columns), orthogonal().column("E_GPa"));
  CHECK(modulus[0].range == Approx(32.008).margin(5e-4));
  CHECK(modulus[0].means[2] == Approx(51.14).margin(5e-5));
  CHECK(modulus[1].range == Approx(8.712).margin(5e-4));
  CHECK(modulus[8].range == Approx(3.960).margin(5e-4));
  CHECK(modulus[4].range == Approx(1.769).margin(5e-4));
  CHECK(modulus[9].range == Approx(1.605).margin(5e-4));
  const auto poisson = ranges(orthogonal().factors(orthogonal_columns), orthogonal().column("nu"));
  CHECK(poisson[1].range == Approx(0.2331).margin(5e-5));
  CHECK(poisson[1].means[1] == Approx(0.2728).margin(5e-5));
  CHECK(poisson[0].range == Approx(0.0237).margin(5e-5));
  CHECK(poisson[4].range == Approx(0.0237).margin(5.1e-5)); // 0.02375
  CHECK(poisson[9].range == Approx(0.0173).margin(5e-5));
}

TEST_CASE("analysis of variance: the published F values of concrete, the null column a factor", "[statistics]")
{
  const std::vector<double> strength           = {0.17, 0.22, 42.38, 36.81, 1.15, 0.05, 0.19,
                                                  0.00, 0.00, 0.21,  2.05,  0.38, 0.06, 0.10};
  const std::vector<double> modulus            = {3004.59, 248.49, 0.64, 3.16, 8.90, 0.69, 0.20,
                                                  0.12,    49.05,  7.29, 0.21, 3.08, 0.31, 31.33};
  const std::vector<double> poisson            = {12.84, 1117.10, 2.24, 0.54, 10.48, 0.75, 1.44,
                                                  1.81,  3.24,    5.87, 0.67, 0.18,  1.79, 1.09};
  const auto [response, printed, error, total] = GENERATE_COPY(
    table<std::string, std::vector<double>, double, double>({{"sigma_u_MPa", strength, 1306.1618, 7559.6986},
                                                             {"E_GPa", modulus, 66.103028, 12750.5416},
                                                             {"nu", poisson, 0.010310328, 0.69376911}}));
  INFO(response);
  const Anova anova = with_null_as_factor(response);
  REQUIRE(anova.effects.size() == 14);
  CHECK(anova.error_degrees == 35);
  CHECK(anova.error_sum == Approx(error).epsilon(1e-7));
  CHECK(anova.total_sum == Approx(total).epsilon(1e-7));
  for (std::size_t factor = 0; factor < 14; ++factor)
    {
      INFO(anova.effects[factor].factor);
      CHECK(anova.effects[factor].degrees == 2);
      CHECK(std::fabs(anova.effects[factor].f - printed[factor]) < 0.0051);
    }
}

TEST_CASE("analysis of variance: sums of squares of type III are those of the level means in proportional designs",
          "[statistics]")
{
  const std::string     response = GENERATE("sigma_u_MPa", "E_GPa", "nu");
  const Eigen::VectorXd y        = orthogonal().column(response);
  const Anova           anova    = with_null_as_factor(response);
  const auto            factors  = orthogonal().factors(orthogonal_columns);
  const auto            means    = ranges(factors, y);
  for (std::size_t factor = 0; factor < factors.size(); ++factor)
    {
      const Levels levels = levels_of(factors[factor].values);
      double       sum    = 0;
      for (std::size_t level = 0; level < levels.values.size(); ++level)
        sum += levels.counts[level] * std::pow(means[factor].means[level] - y.mean(), 2);
      INFO(factors[factor].name);
      CHECK(std::fabs(anova.effects[factor].sum_of_squares - sum) < 1e-10 * anova.total_sum);
    }
}

TEST_CASE("analysis of variance: the null column of the modulus is significant, and pooled it takes others with it",
          "[statistics]")
{
  const Anova as_factor = with_null_as_factor("E_GPa");
  CHECK(f_of(as_factor, "null_col") == Approx(31.3257).margin(5e-5));
  CHECK(as_factor.effects.back().p == Approx(1.6e-8).margin(5e-10));
  const std::vector<std::string> thirteen(orthogonal_columns.begin(), orthogonal_columns.end() - 1);
  const Anova pooled = analyse_variance(orthogonal().factors(thirteen), orthogonal().column("E_GPa"));
  CHECK(pooled.error_degrees == 37);
  CHECK(f_of(pooled, "Ec_GPa") == Approx(1138.4).margin(0.05));
  CHECK(f_of(pooled, "kn_ks") == Approx(94.15).margin(0.005));
  CHECK(f_of(pooled, "Ecj_GPa") == Approx(18.59).margin(0.005));
  CHECK(f_of(pooled, "mu") == Approx(3.37).margin(0.005));
  CHECK(f_of(pooled, "kn_ks_j") == Approx(2.76).margin(0.005));
  CHECK(f_of(pooled, "kn_ks_j") < f_limit(0.05, 2, 37));
}

TEST_CASE("analysis of variance: with the null column as the error, all others are compared with its mean square",
          "[statistics]")
{
  const Anova all = with_null_as_factor("E_GPa");
  const Anova null =
    analyse_variance(orthogonal().factors(orthogonal_columns), orthogonal().column("E_GPa"), "null_col");
  CHECK(null.effects.size() == 13);
  CHECK(null.error_degrees == 2);
  CHECK(null.error_sum == Approx(118.32721).epsilon(1e-7));
  CHECK(f_of(null, "Ec_GPa") == Approx(11349.28 / 118.32721).epsilon(1e-6));
  CHECK_THROWS_WITH(analyse_variance(orthogonal().factors({"Ec_GPa"}), orthogonal().column("nu"), "other"),
                    Catch::Contains("no column other"));
}

TEST_CASE("analysis of variance: run 14 of Poisson's ratio stands out, and without its misprint other factors matter",
          "[statistics]")
{
  const Anova printed = with_null_as_factor("nu");
  CHECK(printed.fit.studentised[13] == Approx(-15.3).margin(0.05));
  CHECK(printed.fit.left_out[13] == Approx(0.140).margin(5e-4));
  CHECK((printed.fit.studentised.cwiseAbs().array() > 4).count() == 1);
  Eigen::VectorXd mended = orthogonal().column("nu");
  CHECK(mended[13] == 0.012);
  mended[13]      = 0.120;
  const Anova now = analyse_variance(orthogonal().factors(orthogonal_columns), mended);
  CHECK(f_of(now, "Ec_GPa") == Approx(60.8).margin(0.05));
  CHECK(f_of(now, "kn_ks") == Approx(7279).margin(0.5));
  CHECK(f_of(now, "sigc_MPa") == Approx(8.28).margin(0.005));
  CHECK(f_of(now, "mu") == Approx(94.4).margin(0.05));
  CHECK(f_of(now, "Ecj_GPa") == Approx(39.2).margin(0.05));
  CHECK(f_of(now, "kn_ks_j") == Approx(54.6).margin(0.05));
}

TEST_CASE("analysis of variance: main effects explain the strength of concrete only in part", "[statistics]")
{
  CHECK(with_null_as_factor("sigma_u_MPa").fit.r_squared() == Approx(0.827).margin(5e-4));
  const std::vector<std::string> thirteen(orthogonal_columns.begin(), orthogonal_columns.end() - 1);
  CHECK(analyse_variance(orthogonal().factors(thirteen), orthogonal().column("sigma_u_MPa")).fit.r_squared() ==
        Approx(0.826).margin(5e-4));
}

TEST_CASE("analysis of variance: of a design without a degree left F is not a number, and aliases are named",
          "[statistics]")
{
  Eigen::VectorXd     response(4);
  std::vector<Factor> factors = {{"a", Eigen::VectorXd(4)}, {"b", Eigen::VectorXd(4)}, {"c", Eigen::VectorXd(4)}};
  response << 1, 2, 4, 9;
  factors[0].values << 0, 0, 1, 1;
  factors[1].values << 0, 1, 0, 1;
  factors[2].values << 0, 1, 1, 0;
  const Anova saturated = analyse_variance(factors, response);
  CHECK(saturated.error_degrees == 0);
  CHECK(std::isnan(saturated.effects[0].f));
  factors[2].values = factors[1].values;
  CHECK_THROWS_WITH(analyse_variance(factors, response), Catch::Contains("do not distinguish these terms") &&
                                                           Catch::Contains("b level 1") &&
                                                           Catch::Contains("c level 1"));
}

TEST_CASE("analysis of variance: sums of type III of an unbalanced table are those of another program", "[statistics]")
{
  // Two factors of two and three levels, eight runs out of proportion; sums by numpy.linalg.lstsq of the models with and without.
  Eigen::VectorXd     response(8);
  std::vector<Factor> factors = {{"a", Eigen::VectorXd(8)}, {"b", Eigen::VectorXd(8)}};
  response << 3.1, 4.2, 5.9, 2.0, 7.7, 8.1, 4.4, 6.3;
  factors[0].values << 0, 0, 0, 1, 1, 1, 1, 0;
  factors[1].values << 0, 1, 2, 0, 2, 2, 1, 2;
  const Anova anova = analyse_variance(factors, response);
  CHECK(anova.effects[0].sum_of_squares == Approx(0.9112500000000008).epsilon(1e-10));
  CHECK(anova.effects[1].sum_of_squares == Approx(28.62375).epsilon(1e-10));
  CHECK(anova.error_sum == Approx(3.113749999999998).epsilon(1e-10));
}
