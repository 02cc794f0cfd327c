#include "tests/apps/interrupted_runs.h"

#include "apps/process/exit_status.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace apps_tests
{
  namespace
  {
    std::vector<std::string> into(std::vector<std::string> arguments, const std::string &output)
    {
      arguments.insert(arguments.end(), {"-o", output});
      return arguments;
    }

    /** A run that is not stopped writes no checkpoints, which take most of its time where they are frequent, and change nothing. */
    std::vector<std::string> without_checkpoints(std::vector<std::string> arguments, const InterruptedRun &what)
    {
      if (what.checkpoints_by_time)
        arguments.insert(arguments.end(), {"-s", "Output/Checkpoint interval=600"});
      return arguments;
    }

    /** A run that was requested to stop says how to go on; one that was killed goes on by the same command. */
    std::vector<std::string> way_to_go_on(const InterruptedRun &what, const Outcome &stopped, const int signal)
    {
      if (signal == SIGKILL)
        {
          REQUIRE(stopped.status == 128 + SIGKILL);
          std::vector<std::string> words = into(what.arguments, "results");
          words.emplace_back("--resume");
          return words;
        }
      REQUIRE(stopped.status == apps::exit_interrupted);
      CHECK_THAT(stopped.err, Catch::Contains("Go on with: breccia run results/running/scene.prm --resume"));
      return {"run", "results/running/scene.prm", "--resume"};
    }

    /** Pictures have the scene's name in their titles, whichever copy of it a run went on from. */
    void check_pictures(const std::filesystem::path &folder, const std::filesystem::path &whole)
    {
      for (const auto &entry : std::filesystem::directory_iterator(whole))
        if (const auto name = entry.path().filename(); name.extension() == ".png")
          {
            INFO(name.string());
            CHECK((content_of(folder / name) == content_of(whole / name)));
          }
    }
  } // namespace

  Outcome interrupted_run(const ScratchFolder &folder, const InterruptedRun &what, const int signal)
  {
    Program    program(folder.path(), into(what.arguments, "results"));
    const auto is_there = [&](const std::string &name) {
      std::error_code not_yet;
      return std::filesystem::exists(folder / "results/running" / name, not_yet);
    };
    while (program.running())
      {
        if (std::all_of(what.awaited.begin(), what.awaited.end(), is_there))
          {
            program.send(signal);
            break;
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    return program.wait();
  }

  void
  goes_on_to_the_same_bits(const ScratchFolder &folder, const InterruptedRun &what, const std::vector<int> &signals)
  {
    const Outcome whole = run(folder.path(), without_checkpoints(into(what.arguments, "whole"), what));
    INFO(whole.err);
    REQUIRE(whole.status == apps::exit_success);
    for (const int signal : signals)
      {
        std::filesystem::remove_all(folder / "results");
        const Outcome stopped = interrupted_run(folder, what, signal);
        INFO(stopped.err);
        const std::vector<std::string> words = way_to_go_on(what, stopped, signal);
        CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
        const Outcome resumed = run(folder.path(), without_checkpoints(words, what));
        INFO(resumed.err);
        REQUIRE(resumed.status == apps::exit_success);
        CHECK(what.reproducible_part(folder / "results") == what.reproducible_part(folder / "whole"));
        check_pictures(folder / "results", folder / "whole");
      }
  }
} // namespace apps_tests
