#include "dem/laws/all.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>

using apps_tests::content_of;
using apps_tests::Outcome;
using apps_tests::run;
using apps_tests::ScratchFolder;
using Catch::Contains;

namespace
{
  /** Collects the keys that a law declares; independent of how apps reads them. */
  struct KeyOfChoice
  {
    std::set<std::string> &keys;
    template <typename Value>
    void operator()(const char *key, Value &, std::initializer_list<std::pair<const char *, Value>>, const char *) const
    {
      keys.insert(key);
    }
  };

  std::set<std::string> keys_of_cpm()
  {
    std::set<std::string> keys;
    dem::CpmParameters    parameters;
    dem::CpmLaw::describe(
      parameters, [&](const char *key, auto &&...) { keys.insert(key); }, KeyOfChoice{keys});
    return keys;
  }
} // namespace

TEST_CASE("describe of a kind's name shows all of it, studies and calibrations as well as scenes", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       study = run(folder.path(), {"describe", "study"}),
                calibration = run(folder.path(), {"describe", "calibration"});
  CHECK_THAT(study.out, Catch::StartsWith("# Scenes of kind study\n") && Contains("subsection Responses") &&
                          Contains("# Scenes of kind sequential")); // whose section has that name
  CHECK_THAT(calibration.out, Catch::StartsWith("# Scenes of kind calibration\n") && Contains("subsection Posterior"));
  CHECK_THAT(run(folder.path(), {"describe", "uniaxial"}).out, Catch::StartsWith("# Scenes of kind uniaxial\n"));
  CHECK_THAT(run(folder.path(), {"describe", "study", "--format", "md"}).out, Contains("## Responses"));
}

TEST_CASE("describe shows every constant of the law, and material constants without a default", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"describe", "Material/CPM", "--format", "json"});
  REQUIRE(outcome.status == 0);
  const nlohmann::json kinds = nlohmann::json::parse(outcome.out); // one description per kind that has the section
  REQUIRE(kinds.size() >= 2);
  const nlohmann::json &section = kinds.front();
  std::set<std::string> shown;
  for (const nlohmann::json &entry : section["entries"])
    {
      shown.insert(entry["name"].get<std::string>());
      CHECK_FALSE(entry["meaning"].get<std::string>().empty());
      CHECK(entry["required"].get<bool>() != entry.contains("default"));
    }
  CHECK(shown == keys_of_cpm());
  for (const nlohmann::json &entry : section["entries"])
    if (entry["name"] == "Cohesion")
      {
        CHECK(entry["unit"] == "Pa");
        CHECK(entry["required"] == true);
      }
}

TEST_CASE("describe writes parameter files, tables and JSON of all sections", "[apps]")
{
  const ScratchFolder folder;
  for (const char *format : {"prm", "md", "json"})
    {
      const Outcome all = run(folder.path(), {"describe", "--format", format});
      REQUIRE(all.status == 0);
      for (const char *section : {"Specimen", "Generator", "Material", "Physics", "Time", "Loading", "Output"})
        CHECK_THAT(all.out, Contains(section));
    }
  CHECK_THAT(run(folder.path(), {"describe", "Time"}).out, Contains("set Step factor = 0.8"));
  CHECK_THAT(run(folder.path(), {"describe", "time", "--format", "md"}).out, Contains("| Step factor | - | 0.8 |"));
}

TEST_CASE("doc/parameters.md is what describe says", "[apps]")
{
  const ScratchFolder folder;
  INFO("build/release/apps/breccia describe --format md > doc/parameters.md");
  // Compared as a whole, not by CHECK: 1000 lines of difference would hide what to do about it.
  const bool same =
    run(folder.path(), {"describe", "--format", "md"}).out == content_of(places::sources() + "/doc/parameters.md");
  CHECK(same);
}

TEST_CASE("describe stops silently when its reader has read enough", "[apps]")
{
  const ScratchFolder folder;
  const std::string   command = "trap '' PIPE; " + places::program() + " describe 2> said | head -n 1 > first";
  REQUIRE(std::system(("cd '" + folder.path().string() + "' && " + command).c_str()) == 0);
  CHECK(content_of(folder / "said").empty());
}

TEST_CASE("describe finds entries and sections by name wherever they are, and says once what kinds share", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       cohesion = run(folder.path(), {"describe", "cohesion"});
  REQUIRE(cohesion.status == 0);
  CHECK_THAT(cohesion.out, Contains("subsection CPM") && Contains("set Cohesion =") && !Contains("Shear ratio"));
  CHECK_THAT(cohesion.out, Contains("# Scenes of kind cell, particles, quasi_static, structure, uniaxial\n"));

  const Outcome cpm = run(folder.path(), {"describe", "CPM"}); // of one material, and of each of several
  REQUIRE(cpm.status == 0);
  CHECK_THAT(cpm.out,
             Contains("subsection Material\n") && Contains("subsection Materials\n") && Contains("Shear ratio"));

  const std::string kind =
    run(folder.path(), {"describe", "Kind", "--kind", "uniaxial"}).out; // the same for every kind of scene
  CHECK_THAT(kind,
             Contains("# Scenes of kind uniaxial\n# What the scene computes: cell (") && Contains("\nset Kind =\n"));
  CHECK_THAT(run(folder.path(), {"describe", "Kind"}).out,
             Contains("# Scenes of kind cell, continuum, ") && !Contains("set Kind = cell"));

  const Outcome one =
    run(folder.path(), {"describe", "Material/CPM/Cohesion", "--kind", "uniaxial", "--format", "json"});
  REQUIRE(one.status == 0);
  const nlohmann::json all     = nlohmann::json::parse(one.out);
  const nlohmann::json section = all.is_array() ? all.front() : all;
  CHECK(section["path"] == "Material/CPM");
  REQUIRE(section["entries"].size() == 1);
  CHECK(section["entries"][0]["name"] == "Cohesion");

  CHECK_THAT(run(folder.path(), {"describe", "Cohesion", "--format", "md"}).out,
             Contains("## Material/CPM\n") && Contains("| Cohesion | Pa |"));
  const Outcome unknown = run(folder.path(), {"describe", "Cohesin"});
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err,
             Contains("there is no section or entry \"Cohesin\"") && Contains("Did you mean \"Cohesion\"?"));
}

TEST_CASE("describe seeks a word that is no name in names, values and texts, the best first", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       triaxial = run(folder.path(), {"describe", "triaxial"});
  REQUIRE(triaxial.status == 0);
  CHECK_THAT(triaxial.out, Contains("set Test =") && Contains("triaxial compression"));
  const Outcome ratio = run(folder.path(), {"describe", "ratio", "--kind", "uniaxial"});
  REQUIRE(ratio.status == 0);
  const auto named = ratio.out.find("set Interaction ratio"), indirect = ratio.out.find("set Rotations");
  CHECK(named != std::string::npos);
  CHECK((indirect == std::string::npos || named < indirect));
}

TEST_CASE("describe seeks several words wherever they stand in what is said of an entry", "[apps]")
{
  const ScratchFolder folder;
  for (const std::vector<std::string> &words :
       {std::vector<std::string>{"describe", "strain", "gauge"}, std::vector<std::string>{"describe", "gauge strain"}})
    {
      const Outcome gauge = run(folder.path(), words);
      REQUIRE(gauge.status == 0);
      CHECK_THAT(gauge.out, Contains("set Gauge length ="));
    }
}

TEST_CASE("describe says in a sentence what does not exist, and does not guess", "[apps]")
{
  const ScratchFolder folder;
  for (const auto &[word, answer] :
       {std::pair{"MPI", "share their work among the processes of mpirun"}, std::pair{"Python", "the module that"},
        std::pair{"calibrate", "doc/tutorials/constants.md"}, std::pair{"CUDA", "graphics processor"},
        std::pair{"fabric", "breccia measure"}, std::pair{"rebar", "not modelled"},
        std::pair{"temperature", "not modelled"}})
    {
      const Outcome outcome = run(folder.path(), {"describe", word});
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err, Contains(answer) && !Contains("Did you mean"));
    }
  for (const char *word : {"Xylophone", "rabar", "strain gouging"})
    CHECK_THAT(run(folder.path(), {"describe", word}).err, Contains("none speaks of it") && !Contains("Did you mean"));
  for (const auto &[typed, meant] : {std::pair{"fracure", "fracture"}, std::pair{"triaxal", "triaxial"}})
    CHECK_THAT(run(folder.path(), {"describe", typed}).err, Contains("Did you mean \"" + std::string(meant) + "\"?"));
}

TEST_CASE("describe names the unit of an entry once", "[apps]")
{
  const ScratchFolder folder;
  const auto          visit = [](const nlohmann::json &section, const auto &self) -> void {
    for (const nlohmann::json &entry : section["entries"])
      {
        const std::string unit = entry["unit"].get<std::string>();
        INFO(section["path"] << "/" << entry["name"]);
        if (!unit.empty())
          CHECK_THAT(entry["meaning"].get<std::string>(), !Contains("[" + unit + "]"));
      }
    for (const nlohmann::json &inner : section["sections"])
      self(inner, self);
  };
  for (const nlohmann::json &kind : nlohmann::json::parse(run(folder.path(), {"describe", "--format", "json"}).out))
    visit(kind, visit);
  CHECK_THAT(run(folder.path(), {"describe", "Compressive strength", "--kind", "continuum"}).out,
             Contains("# f_c, uniaxial [Pa]; "));
}

TEST_CASE("Every law of dem can be described, named in a scene and driven alone", "[apps]")
{
  const ScratchFolder folder;
  const std::string   help  = run(folder.path(), {"link-test", "--help"}).out;
  const std::string   laws  = run(folder.path(), {"describe", "Material"}).out;
  const auto          known = [&](const std::string &name) {
    CHECK_THAT(help, Contains(name));
    CHECK_THAT(laws, Contains("subsection " + name));
  };
  std::apply([&](const auto &...law) { (known(law.name), ...); }, dem::LinkLaws());
}
