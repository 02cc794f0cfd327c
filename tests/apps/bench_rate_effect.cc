#include "apps/bench/rate_effect.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Columns by name, of a table whose first column is a word. */
  std::map<std::string, std::vector<double>> figures_of_rates(const std::string &csv)
  {
    std::istringstream                         lines(csv);
    std::string                                line, cell;
    std::vector<std::string>                   names;
    std::map<std::string, std::vector<double>> columns;
    std::getline(lines, line);
    for (std::istringstream header(line); std::getline(header, cell, ',');)
      names.push_back(cell.substr(0, cell.find(' ')));
    while (std::getline(lines, line))
      {
        std::istringstream cells(line);
        std::getline(cells, cell, ',');
        for (std::size_t c = 1; std::getline(cells, cell, ','); ++c)
          columns[names.at(c)].push_back(std::stod(cell));
      }
    return columns;
  }
} // namespace

TEST_CASE(
  "bench rate-effect: strengths rise with the rate beside the fib Model Code, and a law without delay is refused",
  "[apps][slow]")
{
  CHECK(apps::fib_strength_ratio(true, 1e-6) == 1);
  CHECK(apps::fib_strength_ratio(true, 1) == Approx(1.2823).epsilon(1e-4)); // 10^(6 x 0.018)
  CHECK(apps::fib_strength_ratio(true, 10) == Approx(1.3366).epsilon(1e-4));
  CHECK(apps::fib_strength_ratio(true, 10 * (1 + 1e-9)) == Approx(1.336).epsilon(2e-3)); // its factors are rounded
  CHECK(apps::fib_strength_ratio(false, 30e-6) == 1);
  CHECK(apps::fib_strength_ratio(false, 30) == Approx(1.2134).epsilon(1e-4)); // 10^(6 x 0.014)

  const ScratchFolder folder;
  const std::string   scene = places::sources() + "/apps/scenes/rate_effect.prm";
  const auto          bench = [&](const std::string &rates, const std::string &run_rate, const std::string &where) {
    const Outcome outcome =
      run(folder.path(), {"bench", "rate-effect", scene, "--rates", rates, "-s", "Loading/Tests=tension", "-s",
                          "Loading/Tension/Strain rate=" + run_rate, "-o", where});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return figures_of_rates(content_of(folder / where / "rate_effect.csv"));
  };
  auto                      found = bench("1e-6,1e-3,1,30", "1", "bench");
  const std::vector<double> over = found.at("over_slowest"), inertia = found.at("inertia_alone");
  REQUIRE(over.size() == 4);
  CHECK(over[0] == 1);
  CHECK(inertia[2] == 1); // all three ran at 1 /s
  for (std::size_t i = 1; i < 3; ++i)
    {
      CHECK(over[i] > over[i - 1]);
      CHECK(over[i] == Approx(found.at("fib_model_code")[i]).epsilon(0.1));
    }
  CHECK(over[3] > over[2]);
  for (const double error : found.at("balance_error"))
    CHECK(error < 1e-3);
  // A slow rate is as well run at another speed, with times that are as much shorter.
  const auto elsewhere = bench("1e-3", "0.3", "slower");
  CHECK(elsewhere.at("strength")[0] == Approx(found.at("strength")[1]).epsilon(0.015));

  const Outcome refused = run(folder.path(), {"bench", "rate-effect", scene, "-s", "Material/CPM/Damage time=0"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Material: this bench needs one law with a Damage time or a Plastic time."));
}
