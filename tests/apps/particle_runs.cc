#include "tests/apps/particle_runs.h"

#include <catch2/catch.hpp>

namespace apps_tests
{
  double Results::figure(const char *gauge, const char *when) const
  {
    return summary["figures"][gauge][when]["value"].get<double>();
  }

  double Results::balance_error() const { return summary["energy"]["balance_error"].get<double>(); }

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

  Results results_of(const ScratchFolder &folder, const std::string &scene, const std::vector<std::string> &changes)
  {
    const Outcome outcome = outcome_of(folder, "run", scene, changes);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return {nlohmann::json::parse(content_of(folder / "results/summary.json")),
            postprocess::read_csv_table(folder / "results/series.csv", true)};
  }

  std::string loose_balls(const std::string &effective_modulus)
  {
    return R"(set Kind = particles
subsection Specimen
  set Source  = none
  set Density = 2500
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus = )" +
           effective_modulus + R"(
  end
end
)";
  }
} // namespace apps_tests
