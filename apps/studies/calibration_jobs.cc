// The runs that a set of constants takes, by what decides their results.
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/usual_sizes.h"
#include "apps/studies/calibration_runs.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/digest.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  std::string CalibrationRuns::change_of(const std::string &scene, const std::string &entry, const double value) const
  {
    const std::string text = fmt::format("{}", value);
    const auto        unit = units.find({scene, entry});
    const bool        named =
      unit != units.end() && !question_about(entry.substr(entry.rfind('/') + 1), unit->second, value, text).empty();
    return entry + "=" + text + (named ? " " + unit->second : "");
  }

  bool CalibrationRuns::is_constant_of(const SoughtConstant &constant, const std::string &scene) const
  {
    const std::vector<std::string> names = comma_separated(constant.targets);
    return names.empty() ||
           std::any_of(calibration.targets.begin(), calibration.targets.end(), [&](const CalibrationTarget &target) {
             return scene_of(target) == scene && std::find(names.begin(), names.end(), target.name) != names.end();
           });
  }

  std::vector<std::pair<std::string, std::vector<std::string>>> CalibrationRuns::scenes_at_start() const
  {
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    for (const std::string &scene : scenes)
      all.emplace_back(scene, job_of(scene, at_start(), seeds.front()).changes);
    return all;
  }

  CalibrationRuns::Job
  CalibrationRuns::job_of(const std::string &scene, const Eigen::VectorXd &constants, const std::string &seed) const
  {
    std::vector<std::string> all = changes;
    for (std::size_t k = 0; k < calibration.constants.size(); ++k)
      if (is_constant_of(calibration.constants[k], scene))
        for (const std::string &entry : comma_separated(calibration.constants[k].entries))
          all.push_back(change_of(scene, entry, constants[k]));
    if (!seed.empty())
      all.push_back(calibration.seed_entry + "=" + seed);
    return job_of(scene, all);
  }

  CalibrationRuns::Job CalibrationRuns::job_of(const std::string &scene, const std::vector<std::string> &all) const
  {
    Job job{scene, all, ""};
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
} // namespace apps
