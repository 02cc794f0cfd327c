#include "tests/apps/scene_runs.h"

#include <catch2/catch.hpp>

namespace apps_tests
{
  double Results::figure(const char *probe, const char *when) const
  {
    return summary["figures"][probe][when]["value"].get<double>();
  }

  double Results::balance_error() const { return summary["energy"]["balance_error"].get<double>(); }

  nlohmann::json summary_in(const std::filesystem::path &folder)
  {
    return nlohmann::json::parse(content_of(folder / "summary.json"));
  }

  Outcome outcome_of(const ScratchFolder            &folder,
                     const std::string              &command,
                     const std::string              &scene,
                     const std::vector<std::string> &changes)
  {
    std::vector<std::string> words = {command, scene};
    if (command == "run")
      words.insert(words.end(), {"-o", "results"});
    for (const std::string &change : changes)
      words.insert(words.end(), {"-s", change});
    return run(folder.path(), words);
  }

  void is_refused(const ScratchFolder            &folder,
                  const std::string              &scene,
                  const std::vector<std::string> &changes,
                  const std::string              &words,
                  const std::vector<std::string> &commands)
  {
    for (const std::string &command : commands)
      {
        const Outcome outcome = outcome_of(folder, command, scene, changes);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains(words));
        CHECK_FALSE(std::filesystem::exists(folder / "results"));
      }
  }

  Results results_of(const ScratchFolder            &folder,
                     const std::string              &scene,
                     const std::vector<std::string> &changes,
                     const std::vector<std::string> &word_columns)
  {
    const Outcome outcome = outcome_of(folder, "run", scene, changes);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return {summary_in(folder / "results"),
            postprocess::read_csv_table(folder / "results/series.csv", true, word_columns)};
  }
} // namespace apps_tests
