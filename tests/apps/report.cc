// Pages of runs: what they show, and runs from them.
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::vector<std::string> few = {"-s", "Output/Samples=20", "-s", "Output/Snapshots=0"};

  Outcome run_with(const ScratchFolder &folder, std::vector<std::string> words)
  {
    words.insert(words.end(), few.begin(), few.end());
    return run(folder.path(), words);
  }

  /** A run of the stack with its page, in "first". */
  void leave_run(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", scene_with_file());
    REQUIRE(run_with(folder, {"run", "x.prm", "-o", "first", "-s", "Output/Report=true"}).status == 0);
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

TEST_CASE("report writes of a folder the page that the run itself would have written", "[apps]")
{
  const ScratchFolder folder;
  leave_run(folder);
  const std::string page = content_of(folder / "first/report.html");
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
