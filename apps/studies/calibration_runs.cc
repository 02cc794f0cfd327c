#include "apps/studies/calibration_runs.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/child_runs.h"
#include "apps/studies/measured_curve.h"
#include "apps/studies/scene_entry.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    namespace fs = std::filesystem;

    CurveColumns curve_columns_of(const CalibrationTarget &target)
    {
      return {target.abscissa, target.ordinate, target.test};
    }

    /** "Entry=value; Entry=value" */
    std::vector<std::string> changes_in(const std::string &text)
    {
      std::vector<std::string> changes;
      for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1)
        {
          end                      = std::min(text.find(';', begin), text.size());
          const std::string change = trimmed(text.substr(begin, end - begin));
          if (!change.empty())
            changes.push_back(change);
        }
      return changes;
    }

    /** @param figure "": none @param whose begins the message */
    void demand(const RunOutcome               &known,
                const std::string              &figure,
                const std::vector<std::string> &columns,
                const std::string              &whose)
    {
      try
        {
          if (!figure.empty())
            known.demand_figure(figure);
          for (const std::string &column : columns)
            known.demand_column(column);
        }
      catch (const base::InputError &refusal)
        {
          throw base::InputError(whose + refusal.what());
        }
    }
  } // namespace

  CalibrationRuns::CalibrationRuns(const CalibrationFile &calibration_,
                                   const StudyOptions    &options_,
                                   const Fidelity         fidelity_)
    : calibration(calibration_)
    , options(options_)
    , fidelity(fidelity_)
    , seeds(comma_separated(calibration.seeds_text))
    , changes(fidelity == Fidelity::cheap ? changes_in(calibration.cheap.changes) : std::vector<std::string>())
  {
    if (seeds.empty())
      seeds.push_back("");
    for (const CalibrationTarget &target : calibration.targets)
      if (const std::string scene = scene_of(target); std::find(scenes.begin(), scenes.end(), scene) == scenes.end())
        scenes.push_back(scene);
    if (std::all_of(calibration.targets.begin(), calibration.targets.end(),
                    [](const CalibrationTarget &target) { return target.reference.empty(); }))
      take_measured();
    for (const CalibrationTarget &target : calibration.targets)
      if (!target.reference.empty()) // refused before the first run
        demand_reference(target);
    const Eigen::VectorXd start = at_start();
    Eigen::VectorXd       lower = start, upper = start;
    for (std::size_t k = 0; k < calibration.constants.size(); ++k)
      {
        lower[k] = calibration.constants[k].lower;
        upper[k] = calibration.constants[k].upper;
      }
    for (const Eigen::VectorXd &constants : {start, lower, upper}) // refused before the first run
      jobs_of(constants);
    find_units();
  }

  /** Where the names of what a run can find are known beforehand. */
  void CalibrationRuns::demand_target(const CalibrationTarget &target, const Scene &scene) const
  {
    const std::optional<RunOutcome> known = scene.outcome();
    if (!known)
      return;
    if (target.is_curve())
      demand(*known, "", {target.abscissa, target.ordinate}, calibration.file + ": target " + target.name + ": ");
    else
      demand(*known, target.figure, {}, calibration.file + ": target " + target.name + ": ");
  }

  void CalibrationRuns::demand_reference(const CalibrationTarget &target) const
  {
    job_of(target.reference, std::vector<std::string>());
    const CheckedScene              read  = read_scene(target.reference, {});
    const std::optional<RunOutcome> known = read.scene->outcome();
    const std::string               whose = calibration.file + ": reference of target " + target.name + ": ";
    if (known && target.is_curve())
      demand(*known, "", {target.reference_abscissa, target.reference_ordinate}, whose);
    else if (known)
      demand(*known, target.reference_figure, {}, whose);
  }

  /** Bounds and start have passed the questions about sizes that quantities hardly have: what lies between them is meant. */
  void CalibrationRuns::find_units()
  {
    for (const auto &[scene, changes_at_start] : scenes_at_start())
      {
        const CheckedScene read = read_scene(scene, changes_at_start);
        for (const CalibrationTarget &target : calibration.targets)
          if (scene_of(target) == scene)
            demand_target(target, *read.scene);
        for (const SoughtConstant &constant : calibration.constants)
          for (const std::string &entry : comma_separated(constant.entries))
            if (const Entry *found = entry_at(*read.root, entry))
              units[{scene, entry}] = found->unit;
      }
  }

  Figure CalibrationRuns::figure_of_run(const fs::path &run, const std::string &name)
  {
    RunResult result;
    result.summary = nlohmann::json::parse(postprocess::numeric_text::read_whole(run / "summary.json"));
    return result.figure(name);
  }

  std::string CalibrationRuns::scene_of(const CalibrationTarget &target) const
  {
    return fidelity == Fidelity::cheap && !target.cheap_scene.empty() ? target.cheap_scene : target.scene;
  }

  Eigen::VectorXd CalibrationRuns::at_start() const
  {
    Eigen::VectorXd start(calibration.constants.size());
    for (std::size_t k = 0; k < calibration.constants.size(); ++k)
      start[k] = calibration.constants[k].start;
    return start;
  }

  int CalibrationRuns::together() const
  {
    return options.processes > 0 ? options.processes :
                                   std::max(1, usable_processors() / static_cast<int>(calibration.threads_per_run));
  }

  std::optional<std::string> CalibrationRuns::message_of(const Job &job) const
  {
    if (!std::filesystem::exists(record_of(job)))
      return std::nullopt;
    const auto json = nlohmann::json::parse(postprocess::numeric_text::read_whole(record_of(job)), nullptr, false);
    if (!json.is_object() || !json.contains("message") || !json["message"].is_string())
      throw base::InputError(record_of(job).string() + ": is damaged. Remove it: its run will be repeated.");
    return json["message"].get<std::string>();
  }

  /** Empty where the run has no such figure. */
  Eigen::VectorXd CalibrationRuns::values_of(const Job &job, const std::size_t index) const
  {
    const CalibrationTarget &target = calibration.targets[index];
    if (target.is_curve())
      {
        const Eigen::VectorXd x = places.segment(begins[index], begins[index + 1] - begins[index]);
        return target.ordinate_factor *
               ordinates_at(x / target.abscissa_factor,
                            postprocess::read_csv_table(folder_of(job) / "series.csv", true, {"test"}),
                            curve_columns_of(target));
      }
    const Figure figure = figure_of_run(folder_of(job), target.figure);
    return figure.value ? Eigen::VectorXd(Eigen::VectorXd::Constant(1, target.ordinate_factor * *figure.value)) :
                          Eigen::VectorXd();
  }

  std::optional<Eigen::VectorXd> CalibrationRuns::mean_of(const Eigen::VectorXd &constants) const
  {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(observed.size());
    for (const Job &job : jobs_of(constants))
      {
        if (!message_of(job)->empty())
          return std::nullopt;
        for (std::size_t k = 0; k < calibration.targets.size(); ++k)
          if (scene_of(calibration.targets[k]) == job.scene)
            {
              const Eigen::VectorXd values = values_of(job, k);
              if (values.size() == 0)
                return std::nullopt;
              mean.segment(begins[k], values.size()) += values / static_cast<double>(seeds.size());
            }
      }
    return mean;
  }

  void CalibrationRuns::work_off(const std::vector<Job> &jobs)
  {
    ChildRuns   children(together());
    Progress    progress("calibration");
    std::size_t started = 0, ended = 0;
    while (ended < jobs.size())
      {
        while (started < jobs.size() && children.has_room())
          {
            const Job &job                 = jobs[started];
            const int  threads             = threads_of_a_run(together(), static_cast<int>(calibration.threads_per_run),
                                                              static_cast<std::int64_t>(jobs.size() - ended), longest);
            std::vector<std::string> words = {
              "run", job.scene, "--restart", "--threads", std::to_string(threads), "-o", folder_of(job).string()};
            for (const std::string &change : job.changes)
              words.insert(words.end(), {"-s", change});
            children.start(static_cast<long>(started++), words, log_of(job));
          }
        const auto child = children.wait(std::chrono::milliseconds(200));
        if (interrupted() || (child && child->status == exit_interrupted))
          throw CalibrationInterrupted();
        progress.update(fmt::format("{} of {} runs of this step, {} before", ended, jobs.size(), made));
        if (!child)
          continue;
        const Job &job = jobs[child->job];
        postprocess::write_json(
          record_of(job), {{"changes", job.changes},
                           {"seconds", child->seconds},
                           {"message", child->status == exit_success ? "" : last_words(log_of(job), child->status)}});
        longest = std::max(longest, child->seconds);
        ++ended;
      }
    made += static_cast<int>(jobs.size());
  }

  std::vector<std::optional<Eigen::VectorXd>> CalibrationRuns::predicted(const std::vector<Eigen::VectorXd> &sets)
  {
    std::vector<Job> fresh;
    for (const Eigen::VectorXd &constants : sets)
      for (Job &job : jobs_of(constants))
        if (!message_of(job) &&
            std::none_of(fresh.begin(), fresh.end(), [&job](const Job &other) { return other.key == job.key; }))
          fresh.push_back(std::move(job));
    work_off(fresh);
    std::vector<std::optional<Eigen::VectorXd>> all;
    for (const Eigen::VectorXd &constants : sets)
      all.push_back(mean_of(constants));
    return all;
  }
} // namespace apps
