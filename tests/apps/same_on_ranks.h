#pragma once

#include "tests/apps/program.h"
#include "tests/apps/program_on_ranks.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
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

  /**
   * Meddle with a run on three ranks once a file is there: where one of them cannot write, all are gone in a moment with one message.
   * @param awaited file below results/running @param meddle shell words @param named what the message has once
   */
  inline void are_gone_where_one_cannot_write(const std::string &words,
                                              const std::string &awaited,
                                              const std::string &meddle,
                                              const std::string &named)
  {
    const ScratchFolder folder;
    const int           status =
      shell_in(folder, program_on(3, 1) + words + " -o results & while kill -0 $! && [ ! -e results/running/" +
                         awaited + " ]; do sleep 0.01; done; " + meddle + "; wait $!");
    const std::string said = content_of(folder / "said");
    INFO(said);
    CHECK(status != 0);
    CHECK(occurrences("breccia: ", said) == 2); // the note about its faces, and this
    CHECK(occurrences(named, said) == 1);
  }

  /** Interrupted on three ranks, a run goes on on one and on others to what it gives without. Only the first writes checkpoints. */
  inline void goes_on_on_others(const std::string &words, const std::vector<int> &others = {5})
  {
    const ScratchFolder folder;
    REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o whole") == 0);
    interrupt_on_three(folder, words);
    const auto goes_on = [&](const int ranks, const int threads, const std::string &results) {
      INFO(ranks << " ranks");
      REQUIRE(shell_in(folder, program_on(ranks, threads) + words + " -o " + results + " --resume") == 0);
      CHECK(differences(folder / "whole", folder / results) == std::vector<std::string>());
    };
    for (const int ranks : others)
      {
        const std::string results = "on_" + std::to_string(ranks);
        std::filesystem::copy(folder / "results", folder / results, std::filesystem::copy_options::recursive);
        goes_on(ranks, 1, results);
      }
    goes_on(0, 2, "results");
  }
} // namespace apps_tests
