#include "apps/process/version.h"
#include "apps/studies/calibration.h"
#include "apps/text/value_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace apps
{
  namespace
  {
    nlohmann::json constants_json(const CalibrationFile &file, const Calibration &found)
    {
      nlohmann::json all;
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        {
          const SoughtConstant &constant = file.constants[k];
          all[constant.name]             = {{"value", found.constants[k]},
                                            {"determined", static_cast<bool>(found.determined[k])},
                                            {"standard_error", found.standard_errors[k]},
                                            {"band_95", {found.lower[k], found.upper[k]}},
                                            {"entry", constant.entries},
                                            {"start", constant.start},
                                            {"bounds", {constant.lower, constant.upper}}};
          if (found.posterior)
            all[constant.name]["posterior"] = {{"mean", found.posterior->mean[k]},
                                               {"standard_deviation", found.posterior->standard_deviation[k]},
                                               {"band_95", {found.posterior->lower[k], found.posterior->upper[k]}}};
          for (std::size_t other = 0; other < file.constants.size(); ++other)
            all[constant.name]["correlation"][file.constants[other].name] = found.correlation(k, other);
        }
      return all;
    }

    nlohmann::json
    target_json(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found, const std::size_t k)
    {
      const Eigen::Index begin = runs.first_of(k), count = runs.first_of(k + 1) - begin;
      if (!file.targets[k].is_curve())
        {
          nlohmann::json json = {{"measured", runs.measured()[begin]},
                                 {"predicted", found.predicted[begin]},
                                 {"half_width_95", found.half_widths[begin]}};
          if (found.at_start.size() > 0)
            json["at_start"] = found.at_start[begin];
          if (found.posterior)
            json["posterior_band_95"] = {found.posterior->lowest[begin], found.posterior->highest[begin]};
          return json;
        }
      const Eigen::VectorXd measured  = runs.measured().segment(begin, count),
                            deviation = found.predicted.segment(begin, count) - measured;
      return {{"file", file.targets[k].name + ".csv"},
              {"sum_of_squares", deviation.squaredNorm()},
              {"relative_sum_of_squares", deviation.squaredNorm() / measured.squaredNorm()}};
    }

    std::string posterior_words(const CalibrationFile &file, const Calibration &found)
    {
      if (!found.posterior)
        return "";
      std::string text = fmt::format("\n{:<16} {:>12} {:>12}   {}\n", "posterior", "mean", "deviation", "band of 95 %");
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        text += fmt::format("{:<16} {:>12.6g} {:>12.3g}   {:.6g} to {:.6g}\n", file.constants[k].name,
                            found.posterior->mean[k], found.posterior->standard_deviation[k], found.posterior->lower[k],
                            found.posterior->upper[k]);
      return text;
    }
  } // namespace

  std::vector<std::string> warnings_of(const Calibration &found)
  {
    std::vector<std::string> all = found.warnings;
    if (found.posterior)
      all.insert(all.end(), found.posterior->warnings.begin(), found.posterior->warnings.end());
    return all;
  }

  nlohmann::json json_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found)
  {
    nlohmann::json json = {{"made_by", "breccia " + version()},
                           {"constants", constants_json(file, found)},
                           {"condition", found.condition},
                           {"relative_sum_of_squares", found.relative_sum},
                           {"evaluations", found.evaluations},
                           {"failed", found.failed},
                           {"ending", found.ending},
                           {"model_noise", {{"over_deviation", found.noise}, {"matters", found.noisy}}},
                           {"warnings", found.warnings}};
    if (file.cheap.exists())
      json["cheap_evaluations"] = found.cheap_evaluations;
    if (found.posterior)
      json["posterior"] = {{"runs", found.posterior->runs},
                           {"emulator_error_over_scatter", found.posterior->emulator_error / found.posterior->scatter},
                           {"accepted", found.posterior->accepted},
                           {"drift", found.posterior->drift},
                           {"warnings", found.posterior->warnings}};
    for (std::size_t k = 0; k < file.targets.size(); ++k)
      json["targets"][file.targets[k].name] = target_json(file, runs, found, k);
    return json;
  }

  std::string prm_of(const CalibrationFile &file, const Calibration &found)
  {
    std::string text = "# Found by breccia calibrate " + file.file + "\n";
    for (std::size_t k = 0; k < file.constants.size(); ++k)
      for (const std::string &entry : comma_separated(file.constants[k].entries))
        {
          std::size_t depth = 0, begin = 0;
          for (std::size_t slash; (slash = entry.find('/', begin)) != std::string::npos; begin = slash + 1, ++depth)
            text += std::string(2 * depth, ' ') + "subsection " + entry.substr(begin, slash - begin) + "\n";
          text += std::string(2 * depth, ' ') + "set " + entry.substr(begin) +
                  fmt::format(" = {}", found.constants[k]) +
                  (found.determined[k] ? "\n" : " # not determined by the targets\n");
          while (depth-- > 0)
            text += std::string(2 * depth, ' ') + "end\n";
        }
    return text;
  }

  std::string words_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found)
  {
    std::string text = fmt::format("{:<16} {:>12} {:>12}   {}\n", "constant", "value", "std. error", "band of 95 %");
    for (std::size_t k = 0; k < file.constants.size(); ++k)
      text += found.determined[k] ?
                fmt::format("{:<16} {:>12.6g} {:>12.3g}   {:.6g} to {:.6g}\n", file.constants[k].name,
                            found.constants[k], found.standard_errors[k], found.lower[k], found.upper[k]) :
                fmt::format("{:<16} {:>12.6g}\n", file.constants[k].name, found.constants[k]);
    text += posterior_words(file, found);
    text += fmt::format("\n{:<16} {:>12} {:>12}\n", "target", "measured", "predicted");
    for (std::size_t k = 0; k < file.targets.size(); ++k)
      if (const Eigen::Index begin = runs.first_of(k); file.targets[k].is_curve())
        text += fmt::format(
          "{:<16} a curve, off by {:.3g} % (root mean square, of its root mean square)\n", file.targets[k].name,
          100 * std::sqrt(target_json(file, runs, found, k)["relative_sum_of_squares"].get<double>()));
      else
        text += fmt::format("{:<16} {:>12.6g} {:>12.6g}\n", file.targets[k].name, runs.measured()[begin],
                            found.predicted[begin]);
    text += fmt::format("\n{} sets of constants, {} new runs\n", found.evaluations, runs.runs());
    if (found.cheap_evaluations > 0)
      text += fmt::format("{} sets of the cheap model before\n", found.cheap_evaluations);
    for (const std::string &warning : warnings_of(found))
      text += "warning: " + warning + "\n";
    return text;
  }

  std::string curve_csv_of(const CalibrationFile &file,
                           const CalibrationRuns &runs,
                           const Calibration     &found,
                           const std::size_t      target)
  {
    const CalibrationTarget &own  = file.targets[target];
    std::string              text = own.abscissa + ",measured,predicted,half_width_95" +
                       (found.posterior ? ",posterior_lower_95,posterior_upper_95\n" : "\n");
    for (Eigen::Index k = runs.first_of(target); k < runs.first_of(target + 1); ++k)
      {
        text +=
          fmt::format("{},{},{},{}", runs.abscissae()[k], runs.measured()[k], found.predicted[k], found.half_widths[k]);
        text +=
          found.posterior ? fmt::format(",{},{}\n", found.posterior->lowest[k], found.posterior->highest[k]) : "\n";
      }
    return text;
  }
} // namespace apps
