// Pages of runs: what they show, and runs from them.
#include "apps/results/series_panels.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::vector<std::string> few = {"-s", "Output/Samples=20", "-s", "Output/Snapshots=0"};

  Outcome run_quickly(const ScratchFolder &folder, std::vector<std::string> words)
  {
    words.insert(words.end(), few.begin(), few.end());
    return run(folder.path(), words);
  }

  /** A run of the stack with its page, in "first". */
  void leave_run(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", scene_with_file());
    REQUIRE(run_quickly(folder, {"run", "x.prm", "-o", "first", "-s", "Output/Report=true"}).status == 0);
  }
} // namespace

TEST_CASE("The page of a run, sent elsewhere without any other file, gives the same bits", "[apps]")
{
  const ScratchFolder here, elsewhere;
  leave_run(here);
  const std::string page = content_of(here / "first/report.html");
  for (const char *part : {"Warnings", "tensile_strength", "balance_error", "wall_seconds", "Output/Samples=20",
                           "data:image/png;base64,", "set Law = CPM", "data-entry=\"Specimen/File\""})
    CHECK_THAT(page, Contains(part));
  CHECK(page.size() < 2'000'000);

  elsewhere.file("sent.html", page);
  std::filesystem::remove(here / "packing.txt"); // the page has its own
  REQUIRE(run(elsewhere.path(), {"run", "sent.html", "-o", "again", "-s", "Output/Report=false"}).status == 0);
  CHECK(content_of(elsewhere / "again/series.csv") == content_of(here / "first/series.csv"));
  CHECK_FALSE(std::filesystem::exists(elsewhere / "again/report.html"));

  // The file that the page left beside it is no other one by accident.
  elsewhere.file("sent_files/1_packing.txt", pair_packing());
  const Outcome changed = run(elsewhere.path(), {"check", "sent.html"});
  CHECK(changed.status == 2);
  CHECK_THAT(changed.err, Contains("Specimen/File") && Contains("1_packing.txt") && Contains("is not the file"));
}

TEST_CASE("The energies of a series are drawn together, their balance apart, and nothing of them twice", "[apps]")
{
  postprocess::CsvTable series;
  series.names   = {"time",         "stress",          "energy_kinetic",      "energy_elastic",
                    "energy_start", "energy_residual", "energy_balance_error"};
  series.units   = {"s", "Pa", "J", "J", "J", "J", "-"};
  series.columns = {{0, 1, 2}, {0, 3, 2}, {0, 5, 1}, {0, 1, 4}, {7, 7, 7}, {0, 1e-9, 2e-9}, {0, 1e-10, 2e-10}};
  series.words.resize(series.names.size());
  const auto energies = apps::panels_of_energies(series), columns = apps::panels_of_columns(series);
  REQUIRE(energies.size() == 2);
  REQUIRE(energies[0].series.size() == 2); // what does not change is not drawn
  CHECK(energies[0].series[0].y == std::vector<double>{0, 5, 1});
  CHECK(energies[0].series[1].y == std::vector<double>{0, 1, 4});
  REQUIRE(energies[1].series.size() == 1);
  CHECK(energies[1].series[0].y[2] / energies[1].series[0].y[1] == 2);
  REQUIRE(columns.size() == 1);
  CHECK_THAT(columns[0].y_label, Contains("tress"));
  CHECK(apps::panels_of_series(series).size() == 2);
  series.columns[2] = series.columns[3] = series.columns[5] = {1, 1, 1};
  CHECK(apps::panels_of_energies(series).empty());

  const ScratchFolder folder;
  leave_run(folder);
  const std::string page   = content_of(folder / "first/report.html");
  const std::size_t energy = page.find(">Energy<"), drawn = page.find("Where the energy has come from"),
                    cost = page.find(">Cost<");
  CHECK(energy < drawn);
  CHECK(drawn < cost);
}

TEST_CASE("report writes of a folder the page that the run itself would have written", "[apps]")
{
  const ScratchFolder folder;
  leave_run(folder);
  const std::string page = content_of(folder / "first/report.html");
  REQUIRE(run(folder.path(), {"report", "first", "-o", "other.html"}).status == 0);
  CHECK(content_of(folder / "other.html") == page);
}

TEST_CASE("report reads the summary of an earlier version, whose request is called asked", "[apps]")
{
  const ScratchFolder folder;
  leave_run(folder);
  const std::string page    = content_of(folder / "first/report.html");
  const std::string summary = content_of(folder / "first/summary.json");
  folder.file("first/summary.json", replaced(summary, "\"requested\"", "\"asked\""));
  REQUIRE(run(folder.path(), {"report", "first", "-o", "other.html"}).status == 0);
  CHECK(content_of(folder / "other.html") == page);
}

TEST_CASE("report says of a folder without a complete run what is missing", "[apps]")
{
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "empty");
  const Outcome none = run(folder.path(), {"report", "empty"});
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("empty: no results of a complete run (scene.prm and summary.json)"));
  const Outcome missing = run(folder.path(), {"report", "gone"});
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("gone: there is no such folder"));
  folder.file("page.html", "<html></html>");
  const Outcome page = run(folder.path(), {"run", "page.html"});
  CHECK(page.status == 2);
  CHECK_THAT(page.err, Contains("page.html: there is no scene in this page"));
}
