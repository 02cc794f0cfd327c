#include "apps/studies/replicates.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/results/result_folder.h"
#include "apps/results/result_listing.h"
#include "apps/studies/child_runs.h"
#include "apps/studies/study_journal.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    fs::path log_of_replicate(const fs::path &folder, const long run)
    {
      return folder / "runs" / fmt::format("{:06}.log", run + 1);
    }

    bool can_go_on(const fs::path &folder) { return fs::exists(folder / "running" / checkpoint_name); }

    std::vector<std::string> words_for(const CheckedScene     &scene,
                                       const ReplicateOptions &options,
                                       const ReplicatedRuns   &runs,
                                       const int               threads,
                                       const long              run)
    {
      const fs::path           own   = folder_of_replicate(options.folder, run);
      std::vector<std::string> words = {"run", scene.file, "-o", own.string(), "--threads", std::to_string(threads)};
      words.push_back(can_go_on(own) ? "--resume" : "--restart");
      if (options.no_cache)
        words.push_back("--no-cache");
      for (const auto &changes : {options.overrides, changes_of_replicate(runs.seeds, run)})
        for (const std::string &change : changes)
          words.insert(words.end(), {"-s", change});
      words.insert(words.end(), {"-s", "Replicates=1"});
      return words;
    }

    /** All that decides the results of any number of replicates: those of the first. */
    StudyPlan plan_of_replicates(const CheckedScene &scene, const ReplicateOptions &options)
    {
      std::vector<std::string> changes = options.overrides;
      changes.push_back("Replicates=1");
      const RunRequest request = request_of(read_scene(scene.file, changes));
      StudyPlan        plan;
      plan.text = request.deciding_text;
      for (const InputFile &input : request.inputs)
        plan.text += fmt::format("{} {} {}\n", input.entry, input.bytes, input.digest);
      return plan;
    }

    /** @return false after an interrupt, with checkpoints left */
    bool work_off_replicates(const CheckedScene     &scene,
                             const ReplicateOptions &options,
                             const ReplicatedRuns   &runs,
                             const StudyJournal     &journal)
    {
      std::vector<long> left;
      for (long run = 0; run < scene.replicates; ++run)
        if (!journal.find(run))
          left.push_back(run);
      const SharedThreads shared = shared_threads(options.threads, scene.replicates);
      Progress            progress("replicates");
      ChildRuns           children(shared.runs);
      std::size_t         started = 0, ended = 0, failed = 0;
      while (ended < left.size())
        {
          while (started < left.size() && children.has_room())
            {
              const long run = left[started++];
              children.start(run, words_for(scene, options, runs, shared.threads, run),
                             log_of_replicate(options.folder, run));
            }
          const auto child = children.wait(std::chrono::milliseconds(200));
          if (interrupted() || (child && child->status == exit_interrupted))
            {
              const AnsweringInterrupt answering;
              children.interrupt();
              return false;
            }
          if (child)
            {
              RunRecord record;
              record.seconds = child->seconds;
              if (child->status != exit_success)
                record.message = last_words(log_of_replicate(options.folder, child->job), child->status);
              journal.keep(child->job, record);
              ++ended;
              failed += record.failed();
            }
          progress.update(double(ended) / left.size(),
                          fmt::format("{} of {} runs, {} failed", ended, left.size(), failed));
        }
      return true;
    }

    RunResult result_in(const fs::path &folder)
    {
      RunResult result;
      result.folder  = folder;
      result.summary = nlohmann::json::parse(postprocess::numeric_text::read_whole(folder / "summary.json"));
      if (fs::exists(folder / "series.csv"))
        result.series = postprocess::read_csv_table(folder / "series.csv", true, {"test", "control"});
      return result;
    }
  } // namespace

  std::size_t ReplicatedRuns::failed() const
  {
    return static_cast<std::size_t>(
      std::count_if(messages.begin(), messages.end(), [](const std::string &message) { return !message.empty(); }));
  }

  std::vector<std::string> changes_of_replicate(const std::vector<SceneSeed> &seeds, const long run)
  {
    std::vector<std::string> changes;
    for (const SceneSeed &seed : seeds)
      changes.push_back(fmt::format("{}={}", seed.entry, seed.value + run));
    return changes;
  }

  fs::path folder_of_replicate(const fs::path &folder, const long run)
  {
    return folder / "runs" / fmt::format("{:06}", run + 1);
  }

  std::optional<ReplicatedRuns> replicate(const CheckedScene &scene, const ReplicateOptions &options)
  {
    if (!options.restart)
      refuse_to_overwrite(options.folder); // an interrupted run alone
    ReplicatedRuns runs;
    runs.seeds = seeds_in_use(*scene.root);
    const StudyJournal journal(options.folder, plan_of_replicates(scene, options), 1, 1, options.restart);
    if (!work_off_replicates(scene, options, runs, journal))
      return std::nullopt;
    for (long run = 0; run < scene.replicates; ++run)
      {
        const RunRecord record = *journal.find(run);
        runs.messages.push_back(record.message);
        runs.seconds.push_back(record.seconds);
        runs.results.push_back(record.failed() ? RunResult() : result_in(folder_of_replicate(options.folder, run)));
      }
    if (runs.failed() == runs.messages.size())
      throw base::InputError(
        fmt::format("{}: all {} replicates failed; the first: {}", scene.file, runs.failed(), runs.messages.front()));
    return runs;
  }

  int run_replicates(const CheckedScene &scene, const RunRequest &request, const ReplicateOptions &options)
  {
    const auto runs = replicate(scene, options);
    if (!runs)
      {
        fmt::print(stderr,
                   "breccia: interrupted; runs that are done are kept, those in progress have saved their states. "
                   "The same command goes on.\n");
        return exit_interrupted;
      }
    postprocess::write_text(options.folder / "scene.prm", request.scene_text);
    write_replicates(options.folder, scene, summary_of(scene, request, *runs), *runs);
    fmt::print("{}{}", words_of(*runs), result_listing(options.folder));
    return exit_success;
  }
} // namespace apps
