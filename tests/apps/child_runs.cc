// Processes that a study starts: when there is room for one more.
#include "apps/studies/child_runs.h"

#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <chrono>

using namespace apps_tests;

TEST_CASE("a run more is started only where as much memory is free as the largest so far took", "[apps]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> words = {"--help"}; // of this program, which ends at once
  std::uint64_t                  free  = 0;
  apps::ChildRuns                runs(2, [&free] { return free; });
  CHECK(runs.has_room()); // one always runs, whatever is free
  runs.start(1, words, folder / "1.log");
  CHECK_FALSE(runs.has_room());
  free = 1;
  CHECK(runs.has_room()); // none has ended yet: nothing is known of their memory
  const auto ended = runs.wait(std::chrono::seconds(60));
  REQUIRE(ended);
  CHECK(ended->status == 0);

  runs.start(2, words, folder / "2.log");
  constexpr std::uint64_t of_any_process = 100 << 10, of_none = std::uint64_t(1) << 40;
  free = of_any_process;
  CHECK_FALSE(runs.has_room());
  free = of_none;
  CHECK(runs.has_room());
  runs.start(3, words, folder / "3.log");
  CHECK_FALSE(runs.has_room()); // two at a time
}

TEST_CASE("processors that too few runs are left for go to these, if they last", "[apps]")
{
  using apps::threads_of_a_run;
  constexpr double last = 60, are_short = 1;
  CHECK(threads_of_a_run(8, 1, 20, last) == 1);
  CHECK(threads_of_a_run(8, 1, 8, last) == 1);
  CHECK(threads_of_a_run(8, 1, 5, last) == 1); // eight cannot be shared by five
  CHECK(threads_of_a_run(8, 1, 3, last) == 2);
  CHECK(threads_of_a_run(8, 1, 1, last) == 8);
  CHECK(threads_of_a_run(4, 2, 1, last) == 8);
  CHECK(threads_of_a_run(1, 1, 1, last) == 1);
  CHECK(threads_of_a_run(8, 1, 1, are_short) == 1);
}
