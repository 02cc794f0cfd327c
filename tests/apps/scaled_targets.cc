// breccia invert --check: constants from surfaces, run, and the targets scaled by what the surfaces err.
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A stack of spheres that is pulled, and a study of it by its modulus alone. */
  void write_stack(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    const std::string scene =
      replaced(scene_with_file(), "set Grip thickness", "set Tests = tension\n  set Grip thickness");
    folder.file("stack.prm", replaced(scene, "set Snapshots = 5", "set Snapshots = 0"));
    folder.file("study.prm", R"(set Kind       = study
set Base scene = stack.prm
subsection Design
  set Kind = full factorial
end
subsection Factors
  subsection modulus
    set Entry  = Material/CPM/Normal modulus
    set Levels = 25e9
  end
end
subsection Responses
  subsection E
    set Figure = young_modulus
  end
end
)");
  }

  /** A process of its own: it starts its program again for each run. */
  Outcome typed(const ScratchFolder &folder, const std::vector<std::string> &words)
  {
    return Program(folder.path(), words).wait();
  }
} // namespace

TEST_CASE("breccia invert --check runs what it finds, and corrects the surfaces' targets until the means are met",
          "[apps][slow]")
{
  const ScratchFolder folder;
  write_stack(folder);
  REQUIRE(typed(folder, {"run", "stack.prm", "-o", "truth", "-s", "Material/CPM/Normal modulus=25e9"}).status == 0);
  const double E =
    nlohmann::json::parse(content_of(folder / "truth/summary.json"))["figures"]["young_modulus"]["value"];
  // A surface that is a quarter too stiff: the modulus of a stack of springs is proportional to theirs.
  folder.file("surface.json",
              fmt::format(R"({{"response": {{"name": "E"}}, "surface": {{"box": {{"modulus": [10e9, 60e9]}},
"terms": {{"1": 0, "modulus": {}}}}}}})",
                          1.25 * E / 25e9));
  const std::vector<std::string> words       = {"invert",        "surface.json",
                                                "--target",      fmt::format("E={}", 1.1 * E),
                                                "--starts",      "1",
                                                "--generations", "30",
                                                "--population",  "50",
                                                "--check",       "study.prm",
                                                "--tolerance",   "0.01"};
  std::vector<std::string>       with_folder = words;
  with_folder.insert(with_folder.end(), {"-o", "out"});
  const Outcome outcome = typed(folder, with_folder);
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const auto found = nlohmann::json::parse(content_of(folder / "out/inversion.json"));
  CHECK(found["checked"]["within_tolerance"] == true);
  const auto rounds = found["checked"]["rounds"];
  REQUIRE(rounds.size() == 2);
  CHECK(rounds[0]["responses"]["E"]["mean"].get<double>() == Approx(1.1 * E / 1.25).epsilon(0.01));
  CHECK(rounds[1]["responses"]["E"]["requested"].get<double>() == Approx(1.1 * E * 1.25).epsilon(0.01));
  CHECK(rounds[1]["responses"]["E"]["mean"].get<double>() == Approx(1.1 * E).epsilon(0.01));
  CHECK(found["constants"]["modulus"]["value"].get<double>() == Approx(27.5e9).epsilon(0.01));

  CHECK(typed(folder, words).status == 2); // there is no folder for the runs
  with_folder[3]      = "E=1e9";
  const Outcome other = typed(folder, with_folder);
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("round_1") && Contains("--restart")); // what is there belongs to another target
}

TEST_CASE("breccia invert --check refuses a study without the surfaces' factors and responses by name", "[apps]")
{
  const ScratchFolder folder;
  write_stack(folder);
  const auto refused = [&](const std::string &response, const std::string &factor) {
    folder.file(
      "surface.json",
      fmt::format(
        R"({{"response": {{"name": "{}"}}, "surface": {{"box": {{"{}": [1, 2]}}, "terms": {{"1": 0, "{}": 1}}}}}})",
        response, factor, factor));
    const Outcome outcome =
      typed(folder, {"invert", "surface.json", "--target", response + "=1.5", "--starts", "1", "--generations", "10",
                     "--population", "10", "--check", "study.prm", "-o", "out"});
    CHECK(outcome.status == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "out/round_1"));
    return outcome.err;
  };
  CHECK_THAT(refused("strength", "modulus"), Contains("no response strength") && Contains("There are: E"));
  CHECK_THAT(refused("E", "cohesion"), Contains("no factor cohesion") && Contains("There are: modulus"));
}
