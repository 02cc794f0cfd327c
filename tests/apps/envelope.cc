#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Material M1 of doc/theory/damage-plastic-concrete.md, 6: f_c/f_t = 10. */
  std::vector<std::string> command(const std::vector<std::string> &more)
  {
    std::vector<std::string> words = {"envelope"};
    for (const char *constant : {"Young modulus=30e9", "Poisson ratio=0.2", "Compressive strength=30e6",
                                 "Tensile strength=3e6", "Crack opening=3e-4", "Softening A=35", "Element size=1"})
      words.insert(words.end(), {"-s", constant});
    words.insert(words.end(), more.begin(), more.end()); // later constants win
    return words;
  }
} // namespace

TEST_CASE("envelope: concrete has the biaxial strengths of its yield surface", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), command({"-o", "results", "--directions", "48"}));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const nlohmann::json summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  const auto           figure  = [&](const char *name) { return summary["figures"][name]["value"].get<double>(); };
  // At q = 1 the surface gives f_c, f_t, f_b/f_c = 1.17538 and tau/f_c = 0.0993494; digits as printed.
  // Steps end within 1e-8 of strain of the peak, where hardening is flat.
  CHECK(figure("compressive_strength") == Approx(30e6).epsilon(1e-5));
  CHECK(figure("tensile_strength") == Approx(3e6).epsilon(1e-4));
  CHECK(figure("biaxial_ratio") == Approx(1.17538).epsilon(2e-5));
  CHECK(figure("shear_ratio") == Approx(0.0993494).epsilon(1e-4));

  const postprocess::CsvTable table = postprocess::read_csv_table(folder / "results/envelope.csv");
  REQUIRE(table.rows() == 48);
  const auto &x = table.column("stress_xx"), &y = table.column("stress_yy"), &kappa = table.column("kappa_P");
  for (std::size_t i = 0; i < 48; ++i)
    {
      // Every peak lies on the surface with q = 1 (Grassl and Jirasek 2006), reckoned here.
      const double f_c = 30e6, f_t = 3e6, e = 0.525, m0 = 3 * (f_c * f_c - f_t * f_t) / (f_c * f_t) * e / (e + 1);
      const double mean = (x[i] + y[i]) / 3;
      const double s[3] = {x[i] - mean, y[i] - mean, -mean};
      const double j2 = 0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]), j3 = s[0] * s[1] * s[2];
      const double rho    = std::sqrt(2 * j2);
      const double cos_3t = std::fmin(1, std::fmax(-1, 1.5 * std::sqrt(3.0) * j3 / std::pow(j2, 1.5)));
      const double c = std::cos(std::acos(cos_3t) / 3), k = 1 - e * e;
      const double r = (4 * k * c * c + (2 * e - 1) * (2 * e - 1)) /
                       (2 * k * c + (2 * e - 1) * std::sqrt(4 * k * c * c + 5 * e * e - 4 * e));
      const double f = 1.5 * rho * rho / (f_c * f_c) + m0 * (mean / f_c + rho * r / (std::sqrt(6.0) * f_c)) - 1;
      CAPTURE(table.column("angle")[i], x[i], y[i], f);
      CHECK(std::fabs(f) < 5e-4);
      CHECK(kappa[i] == Approx(1).epsilon(0.05));
      // Symmetric about x = y: direction i and its mirror image.
      const std::size_t mirror = (60 - i) % 48;
      CHECK(x[i] == Approx(y[mirror]).epsilon(1e-6).margin(1));
    }
  CHECK(std::filesystem::file_size(folder / "results/envelope.png") > 1000);
}

TEST_CASE("envelope refuses constants by name and writes nothing", "[apps][S14]")
{
  const ScratchFolder folder;
  const Outcome       missing = run(folder.path(), {"envelope", "-s", "Young modulus=30e9", "-o", "results"});
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("\n  \"Poisson ratio\" [-]: nu"));
  const Outcome wrong = run(folder.path(), command({"-o", "results", "-s", "Poisson ratio=0.6"}));
  CHECK(wrong.status == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "results"));
}
