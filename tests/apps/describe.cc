#include "dem/laws/all.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <set>
#include <string>
#include <utility>

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
    dem::CpmDescription::describe(
      parameters, [&](const char *key, auto &&...) { keys.insert(key); }, KeyOfChoice{keys});
    return keys;
  }
} // namespace

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
