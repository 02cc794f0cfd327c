#include "apps/studies/run_study.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/results/run_result.h"
#include "apps/studies/child_runs.h"
#include "apps/studies/study_report.h"
#include "apps/studies/study_table.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    fs::path folder_of(const StudyJournal &journal, const long run)
    {
      return journal.folder() / "runs" / fmt::format("{:06}", run + 1);
    }

    fs::path log_of(const StudyJournal &journal, const long run)
    {
      return journal.folder() / "runs" / fmt::format("{:06}.log", run + 1);
    }

    /** @throws base::InputError for a column that there is not */
    Figure figure_of_curve(const fs::path &series, const CurveReading &reading)
    {
      const auto table = postprocess::read_csv_table(series, true, {"test"});
      table.column(reading.columns.abscissa);
      table.column(reading.columns.ordinate);
      Figure figure{std::nullopt, reading.unit_in(table), ""};
      try
        {
          figure.value = read_curve(table, reading);
          if (!figure.value)
            figure.not_determined = "the curve does not get as far";
        }
      catch (const base::InputError &problem)
        {
          figure.not_determined = problem.what();
        }
      return figure;
    }

    RunRecord record_of(const StudyFile &study, const StudyJournal &journal, const EndedChild &ended)
    {
      RunRecord record;
      record.seconds = ended.seconds;
      record.responses.resize(study.responses.size());
      record.units.resize(study.responses.size());
      record.reasons.resize(study.responses.size());
      if (ended.status != exit_success)
        {
          record.message = last_words(log_of(journal, ended.job), ended.status);
          return record;
        }
      RunResult result;
      result.summary =
        nlohmann::json::parse(postprocess::numeric_text::read_whole(folder_of(journal, ended.job) / "summary.json"));
      for (std::size_t k = 0; k < study.responses.size(); ++k)
        try
          {
            const StudyResponse &response = study.responses[k];
            const Figure         figure   = response.is_curve() ?
                                              figure_of_curve(folder_of(journal, ended.job) / "series.csv", response.curve) :
                                              result.figure(response.figure);
            record.responses[k]           = figure.value;
            record.units[k]               = figure.unit;
            record.reasons[k]             = figure.not_determined;
          }
        catch (const base::InputError &refusal)
          {
            throw base::InputError(fmt::format("{}: response {}: {}", study.responses[k].place.text(),
                                               study.responses[k].name, refusal.what()));
          }
      return record;
    }

    std::vector<std::string> words_of(const StudyFile    &study,
                                      const StudyPlan    &plan,
                                      const StudyOptions &options,
                                      const fs::path     &folder,
                                      const long          run)
    {
      std::vector<std::string> words = {
        "run", study.base_scene, "--restart", "--threads", std::to_string(study.threads_per_run),
        "-o",  folder.string()};
      if (options.no_cache)
        words.push_back("--no-cache");
      for (const std::string &change : plan.changes[run])
        {
          words.push_back("-s");
          words.push_back(change);
        }
      return words;
    }

    /** Runs of this part that are not in the journal, in their order. */
    std::vector<long> left_to_do(const StudyJournal &journal, const StudyPlan &plan, const StudyOptions &options)
    {
      std::vector<long> left;
      for (long run = options.part - 1; run < plan.values.rows(); run += options.parts)
        if (!journal.find(run))
          left.push_back(run);
      return left;
    }

    /** @return false after an interrupt */
    bool
    work_off(const StudyFile &study, const StudyPlan &plan, const StudyOptions &options, const StudyJournal &journal)
    {
      const std::vector<long> left = left_to_do(journal, plan, options);
      Progress                progress("study");
      ChildRuns               children(processes_of(study, options));
      std::size_t             started = 0, ended = 0, failed = 0;
      while (ended < left.size())
        {
          while (started < left.size() && children.has_room())
            {
              const long run = left[started++];
              children.start(run, words_of(study, plan, options, folder_of(journal, run), run), log_of(journal, run));
            }
          const auto child = children.wait(std::chrono::milliseconds(200));
          if (interrupted() || (child && child->status == exit_interrupted))
            return false;
          if (child)
            {
              const RunRecord record = record_of(study, journal, *child);
              journal.keep(child->job, record);
              ++ended;
              failed += record.failed();
            }
          progress.update(double(ended) / left.size(),
                          fmt::format("{} of {} runs, {} failed", ended, left.size(), failed));
        }
      return true;
    }

    /** Write the table if every run of every part is there. */
    void finish(const StudyFile &study, const StudyPlan &plan, const StudyJournal &journal)
    {
      std::vector<RunRecord> records;
      std::size_t            missing = 0, failed = 0;
      double                 seconds = 0;
      for (Eigen::Index run = 0; run < plan.values.rows(); ++run)
        if (const auto record = journal.find(run))
          {
            records.push_back(*record);
            failed += record->failed();
            seconds += record->seconds;
          }
        else
          ++missing;
      if (missing > 0)
        {
          fmt::print("{}: {} of {} runs are done; other parts have the rest.\n", journal.folder().string(),
                     records.size(), plan.values.rows());
          return;
        }
      const FolderLock alone = journal.lock_of_all_parts(); // other parts may end at the same moment
      write_report(study, plan, records, journal.folder());
      postprocess::write_text(journal.folder() / "table.csv", table_of(study, plan, records));
      fmt::print("{} runs, {} failed, {} together\nwritten to {}: table.csv, report.html, and each run below runs\n",
                 records.size(), failed, duration_text(seconds), journal.folder().string());
    }
  } // namespace

  int processes_of(const StudyFile &study, const StudyOptions &options)
  {
    return options.processes > 0 ? options.processes :
                                   std::max(1, usable_processors() / static_cast<int>(study.threads_per_run));
  }

  int run_study(const StudyFile &study, const StudyPlan &plan, const StudyOptions &options)
  {
    const StudyJournal journal(options.folder, plan, options.part, options.parts, options.restart);
    if (!work_off(study, plan, options, journal))
      {
        fmt::print(stderr, "interrupted; runs that are done are kept. The same command goes on with the others.\n");
        return exit_interrupted;
      }
    finish(study, plan, journal);
    return exit_success;
  }
} // namespace apps
