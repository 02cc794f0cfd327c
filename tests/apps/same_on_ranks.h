#pragma once

#include "tests/apps/program.h"
#include "tests/apps/program_on_ranks.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

/** Runs on ranks whose files have the same bytes. */
namespace apps_tests
{
  inline std::size_t occurrences(const std::string &what, const std::string &in)
  {
    std::size_t count = 0;
    for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1))
      ++count;
    return count;
  }

  /** What all files of a result folder hold, but those that describe the run itself. */
  inline std::map<std::string, std::string> results_in(const std::filesystem::path &folder)
  {
    std::map<std::string, std::string> found;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      if (const std::string name = std::filesystem::relative(entry.path(), folder).string();
          entry.is_regular_file() && name != "summary.json" && name != "scene.prm")
        found[name] = content_of(entry.path());
    return found;
  }

  /** Names of files that differ, or that one of them lacks. */
  inline std::vector<std::string> differences(const std::filesystem::path &one, const std::filesystem::path &other)
  {
    const auto               a = results_in(one), b = results_in(other);
    std::vector<std::string> names;
    for (const auto &[name, content] : a)
      if (b.count(name) == 0 || b.at(name) != content)
        names.push_back(name);
    for (const auto &[name, content] : b)
      if (a.count(name) == 0)
        names.push_back(name);
    return names;
  }

  /** Let a run on three ranks be interrupted once it has written a checkpoint, into `results`. */
  inline void interrupt_on_three(const ScratchFolder &folder, const std::string &words)
  {
    shell_in(folder, program_on(3, 1, noting_its_process) + words +
                       " -s 'Output/Checkpoint interval=0.01' -o results & while kill -0 $! && [ ! -e "
                       "results/running/checkpoint.h5 ]; do sleep 0.01; "
                       "done; " +
                       interrupt_noted + "; wait $!");
    INFO(content_of(folder / "said"));
    REQUIRE_FALSE(std::filesystem::exists(folder / "results/summary.json"));
    CHECK_THAT(content_of(folder / "said"), Catch::Contains("state saved"));
  }

  /** Whether processes that were noted in the folder (noting_its_process) have not ended. */
  inline bool are_at_work(const ScratchFolder &folder)
  {
    for (const auto &entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.path().stem() == "process")
        {
          long          number = 0;
          std::string   name, state;
          std::ifstream noted(entry.path());
          noted >> number;
          if (std::ifstream stat("/proc/" + std::to_string(number) + "/stat"); stat >> number >> name >> state)
            if (state != "Z" && state != "X") // which have ended, and nobody has asked how
              return true;
        }
    return false;
  }

  /** How a run has ended. */
  struct Ending
  {
    int         status; ///< of mpirun
    std::string said;   ///< by all ranks
    double seconds; ///< from the last sign of life until all processes were gone; of a failure, at least what it took
  };

  /**
   * Run on three ranks into `results`, and wait until all processes are gone.
   * @param meanwhile shell words beside it, which may leave the sign of life "meddled"; those before are files of results
   */
  inline Ending
  ending_on_three(const ScratchFolder &folder, const std::string &words, const std::string &meanwhile = "")
  {
    using Clock      = std::filesystem::file_time_type::clock;
    const int status = shell_in(folder, "timeout 60 env " + program_on(3, 1, noting_its_process) + words +
                                          " -o results & " + meanwhile + " wait $!");
    for (const auto end = Clock::now(); are_at_work(folder) && Clock::now() - end < std::chrono::seconds(60);)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const auto gone = Clock::now();
    auto       last = std::filesystem::file_time_type::min();
    if (std::filesystem::exists(folder / "meddled"))
      last = std::filesystem::last_write_time(folder / "meddled");
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder / "results"))
      last = std::max(last, entry.last_write_time());
    CHECK_FALSE(are_at_work(folder));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder / "said"),
            std::chrono::duration<double>(gone - last).count()};
  }

  /** Shell words that wait for a file below results/running of the run before them, or for its end. */
  inline std::string until_written(const std::string &awaited)
  {
    return "while kill -0 $! && [ ! -e results/running/" + awaited + " ]; do sleep 0.01; done; ";
  }

  /** All ranks are to be gone so soon after one of them has failed [s]. */
  constexpr double gone_within = 5;

  /**
   * Meddle with a run on three ranks once a file is there: where one of them cannot write, all are gone in a moment with one message.
   * @param awaited file below results/running @param meddle shell words; process.RANK names its process
   * @param named what the message has once
   */
  inline void are_gone_where_one_cannot_write(const std::string &words,
                                              const std::string &awaited,
                                              const std::string &meddle,
                                              const std::string &named)
  {
    const ScratchFolder folder;
    const Ending        ending = ending_on_three(folder, words, until_written(awaited) + meddle + "; touch meddled;");
    INFO(ending.said);
    CHECK(ending.status == 2);
    CHECK(ending.seconds < gone_within);
    CHECK(occurrences("breccia: ", ending.said) == 2); // the note about its faces, and this
    CHECK(occurrences(named, ending.said) == 1);
  }

  /**
   * What was interrupted into `results` goes on, in a copy, to what is in `whole`.
   * @param ranks 0: without mpirun
   */
  inline void goes_on(const ScratchFolder &folder, const std::string &words, const int ranks, const int threads)
  {
    INFO(ranks << " ranks");
    const std::string results = "on_" + std::to_string(ranks);
    std::filesystem::copy(folder / "results", folder / results, std::filesystem::copy_options::recursive);
    REQUIRE(shell_in(folder, program_on(ranks, threads) + words + " -o " + results + " --resume") == 0);
    CHECK(differences(folder / "whole", folder / results) == std::vector<std::string>());
  }

  /** Interrupted on three ranks, a run goes on on one and on others to what it gives without. Only the first writes checkpoints. */
  inline void goes_on_on_others(const std::string &words, const std::vector<int> &others = {5})
  {
    const ScratchFolder folder;
    REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o whole") == 0);
    interrupt_on_three(folder, words);
    for (const int ranks : others)
      goes_on(folder, words, ranks, 1);
    goes_on(folder, words, 0, 2);
  }
} // namespace apps_tests
