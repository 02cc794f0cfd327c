#include "apps/studies/calibration_runs.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/child_runs.h"
#include "apps/studies/measured_curve.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/digest.h"
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
    CurveColumns curve_columns_of(const CalibrationTarget &target)
    {
      return {target.abscissa, target.ordinate, target.test};
    }

    /** What a residual is divided by: the standard deviation, or what makes targets of one weight count alike. */
    double scale_of_target(const CalibrationTarget &target, const Eigen::VectorXd &measured)
    {
      if (target.deviation > 0)
        return target.deviation;
      return measured.cwiseAbs().maxCoeff() * std::sqrt(static_cast<double>(measured.size()) / target.weight);
    }
  } // namespace

  CalibrationRuns::CalibrationRuns(const CalibrationFile &calibration_, const StudyOptions &options_)
    : calibration(calibration_)
    , options(options_)
    , seeds(comma_separated(calibration.seeds_text))
    , begins({0})
  {
    if (seeds.empty())
      seeds.push_back("");
    std::vector<double> values, abscissae, scales;
    for (const CalibrationTarget &target : calibration.targets)
      {
        if (std::find(scenes.begin(), scenes.end(), target.scene) == scenes.end())
          scenes.push_back(target.scene);
        Eigen::VectorXd x = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN());
        Eigen::VectorXd y = Eigen::VectorXd::Constant(1, target.value);
        if (target.is_curve())
          {
            const auto         table = postprocess::read_csv_table(target.curve, true);
            const CurveColumns whole{target.abscissa, target.ordinate, ""};
            x = abscissae_of(table, whole);
            y = ordinates_at(x, table, whole);
          }
        abscissae.insert(abscissae.end(), x.begin(), x.end());
        values.insert(values.end(), y.begin(), y.end());
        scales.insert(scales.end(), static_cast<std::size_t>(y.size()), scale_of_target(target, y));
        begins.push_back(static_cast<Eigen::Index>(values.size()));
      }
    const auto n = static_cast<Eigen::Index>(values.size());
    observed     = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    places       = Eigen::Map<const Eigen::VectorXd>(abscissae.data(), n);
    deviations   = Eigen::Map<const Eigen::VectorXd>(scales.data(), n);

    Eigen::VectorXd start(calibration.constants.size()), lower = start, upper = start;
    for (std::size_t k = 0; k < calibration.constants.size(); ++k)
      {
        start[k] = calibration.constants[k].start;
        lower[k] = calibration.constants[k].lower;
        upper[k] = calibration.constants[k].upper;
      }
    for (const Eigen::VectorXd &constants : {start, lower, upper}) // refused before the first run
      jobs_of(constants);
  }

  CalibrationRuns::Job
  CalibrationRuns::job_of(const std::string &scene, const Eigen::VectorXd &constants, const std::string &seed) const
  {
    Job job{scene, {}, ""};
    for (std::size_t k = 0; k < calibration.constants.size(); ++k)
      for (const std::string &entry : comma_separated(calibration.constants[k].entries))
        job.changes.push_back(fmt::format("{}={}", entry, constants[k]));
    if (!seed.empty())
      job.changes.push_back(calibration.seed_entry + "=" + seed);
    try
      {
        const CheckedScene  read    = read_scene(scene, job.changes);
        const RunRequest    request = request_of(read);
        postprocess::Digest digest;
        digest.add(request.deciding_text);
        for (const InputFile &input : request.inputs)
          digest.add(fmt::format("{} {} {}\n", input.entry, input.bytes, input.digest));
        job.key = fmt::format("{:016x}", digest.value());
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(
          fmt::format("{}: {} ({}): {}", calibration.file, scene, fmt::join(job.changes, ", "), refusal.what()));
      }
    return job;
  }

  std::vector<CalibrationRuns::Job> CalibrationRuns::jobs_of(const Eigen::VectorXd &constants) const
  {
    std::vector<Job> jobs;
    for (const std::string &scene : scenes)
      for (const std::string &seed : seeds)
        jobs.push_back(job_of(scene, constants, seed));
    return jobs;
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
      return ordinates_at(places.segment(begins[index], begins[index + 1] - begins[index]),
                          postprocess::read_csv_table(folder_of(job) / "series.csv", true, {"test"}),
                          curve_columns_of(target));
    RunResult result;
    result.summary      = nlohmann::json::parse(postprocess::numeric_text::read_whole(folder_of(job) / "summary.json"));
    const Figure figure = result.figure(target.figure);
    return figure.value ? Eigen::VectorXd(Eigen::VectorXd::Constant(1, *figure.value)) : Eigen::VectorXd();
  }

  std::optional<Eigen::VectorXd> CalibrationRuns::mean_of(const Eigen::VectorXd &constants) const
  {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(observed.size());
    for (const Job &job : jobs_of(constants))
      {
        if (!message_of(job)->empty())
          return std::nullopt;
        for (std::size_t k = 0; k < calibration.targets.size(); ++k)
          if (calibration.targets[k].scene == job.scene)
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
    const int   together = std::max(1, usable_processors() / static_cast<int>(calibration.threads_per_run));
    ChildRuns   children(options.processes > 0 ? options.processes : together);
    std::size_t started = 0, ended = 0;
    while (ended < jobs.size())
      {
        while (started < jobs.size() && children.has_room())
          {
            const Job               &job   = jobs[started];
            std::vector<std::string> words = {"run",
                                              job.scene,
                                              "--restart",
                                              "--threads",
                                              std::to_string(calibration.threads_per_run),
                                              "-o",
                                              folder_of(job).string()};
            for (const std::string &change : job.changes)
              words.insert(words.end(), {"-s", change});
            children.start(static_cast<long>(started++), words, log_of(job));
          }
        const auto child = children.wait(std::chrono::milliseconds(200));
        if (interrupted() || (child && child->status == exit_interrupted))
          throw CalibrationInterrupted();
        if (!child)
          continue;
        const Job &job = jobs[child->job];
        postprocess::write_json(
          record_of(job), {{"changes", job.changes},
                           {"seconds", child->seconds},
                           {"message", child->status == exit_success ? "" : last_words(log_of(job), child->status)}});
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
