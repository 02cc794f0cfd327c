// Replicates: a scene run with several seeds.
#include "apps/studies/replicates.h"

#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/replicate_statistics.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/concrete_stack.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

using namespace apps_tests;
using Catch::Contains;
using Catch::WithinRel;

namespace
{
  apps::RunResult run_with(const nlohmann::json &figures)
  {
    apps::RunResult result;
    result.summary = {{"figures", figures}};
    return result;
  }

  nlohmann::json figure(const double value) { return {{"value", value}, {"unit", "Pa"}}; }

  /** Points (x, slope x) of a test. */
  postprocess::CsvTable straight_line(const std::string &test, const double end, const int points, const double slope)
  {
    postprocess::CsvTable series =
      apps::empty_series({{"test", "", true}, {"strain", "-"}, {"stress", "Pa"}}, "straight line");
    for (int k = 1; k <= points; ++k)
      apps::append(series, {{test}, {end * k / points, slope * end * k / points}, {}});
    return series;
  }

  /** In a folder with a stack of concrete. A process of its own, as it starts its program again. */
  Outcome replicates(const ScratchFolder &folder, const std::vector<std::string> &options)
  {
    std::vector<std::string> words = {"run", "x.prm"};
    words.insert(words.end(), options.begin(), options.end());
    return Program(folder.path(), words).wait();
  }

  void write_stack(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", replaced(concrete_stack(), "set Snapshots = 5", "set Snapshots = 0"));
  }
} // namespace

TEST_CASE("replicates: mean and unbiased deviation of a figure are those of the runs that have it", "[apps]")
{
  const std::vector<apps::RunResult> runs = {
    run_with({{"a", figure(1)}, {"b", {{"c", figure(2)}}}}), run_with({{"a", figure(2)}}), apps::RunResult(), // failed
    run_with({{"a", figure(4)}, {"b", {{"c", {{"value", nullptr}, {"unit", "Pa"}, {"not_determined", "no peak"}}}}}})};
  const std::vector<apps::ReplicatedFigure> found = apps::replicated_figures(runs);
  REQUIRE(found.size() == 2);
  CHECK(found[0].path == "a");
  CHECK_THAT(found[0].mean(), WithinRel(7.0 / 3, 1e-15));
  CHECK_THAT(found[0].standard_deviation().value(), WithinRel(std::sqrt(7.0 / 3), 1e-15)); // (16 + 1 + 25) / 9 / 2
  CHECK_FALSE(found[0].values[2]);
  CHECK(found[1].path == "b/c");
  CHECK(found[1].mean() == 2);
  CHECK_FALSE(found[1].standard_deviation());
  CHECK(found[1].not_determined == "no peak");
}

TEST_CASE("replicates: the band of two straight lines is a straight line, as far as both of them reach", "[apps]")
{
  const double                 end    = -2e-3; // compressed
  const apps::ReplicatedSeries series = apps::replicated_series(
    {straight_line("compression", end, 40, 1e9), straight_line("compression", 2 * end, 33, 3e9)});
  REQUIRE(series.table.rows() == apps::points_of_band);
  CHECK(series.tests.size() == apps::points_of_band);
  const std::vector<double> &strain = series.table.column("strain"), &stress = series.table.column("stress"),
                            &deviation = series.table.column("stress_deviation");
  CHECK_THAT(strain.front(), WithinRel(2 * end / 33, 1e-12)); // where the later one begins
  CHECK_THAT(strain.back(), WithinRel(end, 1e-12));
  for (std::size_t row = 0; row < strain.size(); ++row)
    {
      CHECK_THAT(stress[row], WithinRel(2e9 * strain[row], 1e-12));
      CHECK_THAT(deviation[row], WithinRel(std::sqrt(2.0) * 1e9 * std::fabs(strain[row]), 1e-9));
    }
}

TEST_CASE("replicates: every seed that something is drawn by is counted up, and there must be one", "[apps]")
{
  const ScratchFolder folder;
  write_stack(folder);
  const apps::CheckedScene scene = apps::read_scene((folder / "x.prm").string(), {"Specimen/Mix/Seed=7"});
  const auto               seeds = apps::seeds_in_use(*scene.root); // its packing is a file: that of the mix alone
  REQUIRE(seeds.size() == 1);
  CHECK(apps::changes_of_replicate(seeds, 2) == std::vector<std::string>{"Specimen/Mix/Seed=9"});
  folder.file("plain.prm", scene_with_file());
  CHECK_THROWS_WITH(apps::read_scene((folder / "plain.prm").string(), {"Replicates=3"}),
                    Contains("Replicates") && Contains("nothing of this scene is drawn by a seed"));
}

TEST_CASE("replicates: each is the run of its seed, and the summary has their mean; more of them repeat none",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_stack(folder);
  REQUIRE(replicates(folder, {"-o", "alone", "-s", "Specimen/Mix/Seed=2"}).status == 0);
  const Outcome two = replicates(folder, {"-o", "both", "-s", "Replicates=2"});
  INFO(two.err);
  REQUIRE(two.status == 0);
  CHECK(summary_in(folder / "both/runs/000002")["figures"] == summary_in(folder / "alone")["figures"]);
  const nlohmann::json strength = summary_in(folder / "both")["figures"]["tensile_strength"];
  const double first  = summary_in(folder / "both/runs/000001")["figures"]["tensile_strength"]["value"].get<double>(),
               second = summary_in(folder / "alone")["figures"]["tensile_strength"]["value"].get<double>();
  CHECK(first != second);
  CHECK_THAT(strength["value"].get<double>(), WithinRel((first + second) / 2, 1e-14));
  CHECK_THAT(strength["standard_deviation"].get<double>(), WithinRel(std::fabs(first - second) / std::sqrt(2.0), 1e-9));
  CHECK(std::filesystem::exists(folder / "both/replicates.png"));
  const auto series = postprocess::read_csv_table(folder / "both/series.csv", true, {"test"});
  CHECK(series.rows() == 2 * apps::points_of_band); // of both tests

  const auto    made  = std::filesystem::last_write_time(folder / "both/runs/000001/summary.json");
  const Outcome three = replicates(folder, {"-o", "both", "-s", "Replicates=3"});
  REQUIRE(three.status == 0);
  CHECK(std::filesystem::last_write_time(folder / "both/runs/000001/summary.json") == made);
  CHECK(summary_in(folder / "both")["figures"]["tensile_strength"]["values"].size() == 3);

  const Outcome other = replicates(folder, {"-o", "both", "-s", "Replicates=3", "-s", "Specimen/Density=4000"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("holds the runs of another study"));
}

TEST_CASE("replicates that are interrupted go on to the same results, and repeat no run that is done", "[apps][slow]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> options = {"-s", "Replicates=4", "--threads", "1", "-o"};
  const auto                     into    = [&options](const std::string &name) {
    std::vector<std::string> words = options;
    words.push_back(name);
    return words;
  };
  write_stack(folder);
  REQUIRE(replicates(folder, into("whole")).status == 0);

  std::vector<std::string> words = {"run", "x.prm"};
  for (const std::string &word : into("parts"))
    words.push_back(word);
  Program    stopped(folder.path(), words);
  const auto first = folder / "parts/journal/000001.json";
  while (stopped.running() && !std::filesystem::exists(first))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  stopped.send(SIGINT);
  const Outcome outcome = stopped.wait();
  CHECK(outcome.status == 130);
  CHECK_FALSE(std::filesystem::exists(folder / "parts/summary.json"));
  const auto made = std::filesystem::last_write_time(first);

  const Outcome goes_on = replicates(folder, into("parts"));
  INFO(goes_on.err);
  REQUIRE(goes_on.status == 0);
  CHECK(std::filesystem::last_write_time(first) == made);
  CHECK(content_of(folder / "parts/replicates.csv") == content_of(folder / "whole/replicates.csv"));
  CHECK(content_of(folder / "parts/series.csv") == content_of(folder / "whole/series.csv"));
}
