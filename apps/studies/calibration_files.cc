#include "apps/process/version.h"
#include "apps/studies/calibration.h"

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
        return {{"measured", runs.measured()[begin]},
                {"predicted", found.predicted[begin]},
                {"half_width_95", found.half_widths[begin]}};
      const Eigen::VectorXd measured  = runs.measured().segment(begin, count),
                            deviation = found.predicted.segment(begin, count) - measured;
      return {{"file", file.targets[k].name + ".csv"},
              {"sum_of_squares", deviation.squaredNorm()},
              {"relative_sum_of_squares", deviation.squaredNorm() / measured.squaredNorm()}};
    }
  } // namespace

  nlohmann::json json_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found)
  {
    nlohmann::json json = {{"made_by", "breccia " + version()},
                           {"constants", constants_json(file, found)},
                           {"condition", found.condition},
                           {"relative_sum_of_squares", found.relative_sum},
                           {"evaluations", found.evaluations},
                           {"failed", found.failed},
                           {"ending", found.ending},
                           {"warnings", found.warnings}};
    for (std::size_t k = 0; k < file.targets.size(); ++k)
      json["targets"][file.targets[k].name] = target_json(file, runs, found, k);
    return json;
  }

  std::string words_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found)
  {
    std::string text = fmt::format("{:<16} {:>12} {:>12}   {}\n", "constant", "value", "std. error", "band of 95 %");
    for (std::size_t k = 0; k < file.constants.size(); ++k)
      text += found.determined[k] ?
                fmt::format("{:<16} {:>12.6g} {:>12.3g}   {:.6g} to {:.6g}\n", file.constants[k].name,
                            found.constants[k], found.standard_errors[k], found.lower[k], found.upper[k]) :
                fmt::format("{:<16} {:>12.6g}\n", file.constants[k].name, found.constants[k]);
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
    for (const std::string &warning : found.warnings)
      text += "warning: " + warning + "\n";
    return text;
  }

  std::string curve_csv_of(const CalibrationFile &file,
                           const CalibrationRuns &runs,
                           const Calibration     &found,
                           const std::size_t      target)
  {
    const CalibrationTarget &own  = file.targets[target];
    std::string              text = own.abscissa + ",measured,predicted,half_width_95\n";
    for (Eigen::Index k = runs.first_of(target); k < runs.first_of(target + 1); ++k)
      text +=
        fmt::format("{},{},{},{}\n", runs.abscissae()[k], runs.measured()[k], found.predicted[k], found.half_widths[k]);
    return text;
  }
} // namespace apps
