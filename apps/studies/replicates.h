#pragma once

#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/kinds/seeds.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  struct ReplicateOptions
  {
    std::filesystem::path    folder;
    std::vector<std::string> overrides;   ///< of the scene, as typed
    int                      threads = 1; ///< of all runs together
    bool                     restart = false, no_cache = false;
  };

  /** What several runs of one scene found, each with seeds of its own. */
  struct ReplicatedRuns
  {
    std::vector<SceneSeed>   seeds;    ///< of the first run; those of run k, from 0, are larger by k
    std::vector<RunResult>   results;  ///< without a summary where a run failed
    std::vector<std::string> messages; ///< why it failed; "": it did not
    std::vector<double>      seconds;

    std::size_t failed() const;
  };

  /** "Specimen/Mix/Seed=3": the changes that make of a scene its run of that number, from 0. */
  std::vector<std::string> changes_of_replicate(const std::vector<SceneSeed> &seeds, long run);

  /**
   * The runs of a scene with `Replicates` in processes of their own, below FOLDER/runs. What the folder holds of the same scene is not
   * repeated, however many replicates there were; interrupted runs go on from their checkpoints.
   * @return nothing after an interrupt
   * @throws base::InputError where the folder holds runs of another scene, or all fail; postprocess::OutputError
   */
  std::optional<ReplicatedRuns> replicate(const CheckedScene &scene, const ReplicateOptions &options);

  /** FOLDER/runs/000001 */
  std::filesystem::path folder_of_replicate(const std::filesystem::path &folder, long run);

  /** What summary.json holds: of each figure mean, scatter and values (doc/formats.md). */
  nlohmann::json summary_of(const CheckedScene &scene, const RunRequest &request, const ReplicatedRuns &runs);

  /** Write summary.json, replicates.csv, series.csv and replicates.png. What cannot be averaged or drawn costs a warning. */
  void write_replicates(const std::filesystem::path &folder,
                        const CheckedScene          &scene,
                        const nlohmann::json        &summary,
                        const ReplicatedRuns        &runs);

  /** Lines for a terminal: each figure with its scatter. */
  std::string words_of(const ReplicatedRuns &runs);

  /** All of it: run, write and print. @return exit status */
  int run_replicates(const CheckedScene &scene, const RunRequest &request, const ReplicateOptions &options);
} // namespace apps
