#pragma once

#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/** What a shipped scene leaves behind. */
struct SceneResults
{
  nlohmann::json        summary;
  postprocess::CsvTable series;
  postprocess::CsvTable breaks  = {}; ///< no columns: the scene has no log of them
  nlohmann::json        genesis = {}; ///< null: the scene grew nothing

  double figure(const char *name) const { return summary["figures"][name]["value"].get<double>(); }
};

/** Run a shipped scene with changes, without snapshots. */
inline SceneResults results_of(const std::string &scene, const std::vector<std::string> &changes = {})
{
  const apps_tests::ScratchFolder folder;
  std::vector<std::string>        words = {
           "run", places::sources() + "/apps/scenes/" + scene + ".prm", "-o", "results", "-s", "Output/Snapshots=0"};
  for (const std::string &change : changes)
    words.insert(words.end(), {"-s", change});
  const apps_tests::Outcome outcome = apps_tests::run(folder.path(), words);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  SceneResults found{nlohmann::json::parse(apps_tests::content_of(folder / "results/summary.json")),
                     postprocess::read_csv_table(folder / "results/series.csv", false, {"test"})};
  if (const auto log = folder / "results/breaks.csv"; std::filesystem::exists(log))
    found.breaks = postprocess::read_csv_table(log, false, {"mode", "pair", "surface"});
  if (const auto grown = folder / "results/genesis.json"; std::filesystem::exists(grown))
    found.genesis = nlohmann::json::parse(apps_tests::content_of(grown));
  return found;
}
