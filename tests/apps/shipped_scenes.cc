#include "apps/scene/description.h"
#include "apps/scene/kinds/read_scene.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** What `check` doubts, by words of its message, and what a page says that explains it. */
  struct Explanation
  {
    const char *message, *on_the_page;
  };

  const std::vector<Explanation> explanations = {
    {"the faces of the specimen are cut and sparse", "note[^.]* cut|cut[^.]* note"},
    {"impedances reflect", "reflect"},
    {"the mapping law \"default\" belongs to", "mapping law `default`"},
    {"are linked to nothing", "no bond reaches|linked to nothing"}};

  /** Lines of what `check` wrote that ask for an explanation; what it has placed is information. */
  std::vector<std::string> doubts_in(const std::string &text)
  {
    std::vector<std::string> doubts;
    std::istringstream       lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.find("breccia: note: mix: ") != 0 && (line.find("breccia: note: ") == 0 || line.find("  warning ") == 0))
        doubts.push_back(line);
    return doubts;
  }

  /** All pages that tell how to run the scene; the index names all scenes and explains none. */
  std::string pages_of(const std::filesystem::path &scene)
  {
    std::string pages;
    for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/doc/tutorials"))
      if (entry.path().extension() == ".md" && entry.path().filename() != "README.md")
        if (const std::string page = content_of(entry.path());
            page.find("apps/scenes/" + scene.filename().string()) != std::string::npos)
          pages += page;
    return pages;
  }

  bool is_explained(const std::string &doubt, const std::string &pages)
  {
    return std::any_of(explanations.begin(), explanations.end(), [&](const Explanation &one) {
      return doubt.find(one.message) != std::string::npos && std::regex_search(pages, std::regex(one.on_the_page));
    });
  }
} // namespace

TEST_CASE("Every scene that is shipped is valid and can be set up, and its page explains what check doubts",
          "[apps][slow]")
{
  const ScratchFolder folder;
  int                 scenes = 0, doubted = 0;
  for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/apps/scenes"))
    {
      const std::string extension = entry.path().extension().string();
      if (extension != ".prm" && extension != ".json")
        continue;
      INFO(entry.path());
      const Outcome outcome = run(folder.path(), {"check", entry.path().string()});
      INFO(outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("valid"));
      for (const std::string &doubt : doubts_in(outcome.out + outcome.err))
        {
          INFO(doubt);
          CHECK(is_explained(doubt, pages_of(entry.path())));
          ++doubted;
        }
      ++scenes;
    }
  CHECK(scenes >= 3);
  CHECK(doubted >= 3); // the words of a doubt are still those that are looked for
}

TEST_CASE("Every scene that is shipped reads the same as it is completed in a result folder", "[apps]")
{
  const ScratchFolder folder;
  for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/apps/scenes"))
    {
      if (!entry.is_regular_file()) // tables, and designs of studies
        continue;
      INFO(entry.path());
      const apps::CheckedScene requested = apps::read_scene(entry.path().string(), {});
      const auto file = folder.file("scene.prm", completed_scene(*requested.root, apps::Completed::everything));
      const apps::CheckedScene again = apps::read_scene(file, {});
      CHECK(completed_scene(*again.root, apps::Completed::what_decides_results) ==
            completed_scene(*requested.root, apps::Completed::what_decides_results));
    }
}

TEST_CASE("The first scene that a reader runs ends without a warning", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"run", places::sources() + "/apps/scenes/quick_uniaxial.prm", "-o",
                                                    "results", "-s", "Output/Snapshots=0"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, !Contains("warning"));
  CHECK_THAT(outcome.err, !Contains("note:"));
  const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  CHECK(summary["warnings"].empty());
  for (const auto &test : summary["tests"])
    CHECK(test["peak_passed"] == true);
}
