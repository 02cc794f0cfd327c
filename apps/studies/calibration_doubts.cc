#include "apps/studies/calibration_doubts.h"

namespace apps
{
  bool ends_at_its_peak(const Eigen::VectorXd &ordinates)
  {
    Eigen::Index at = 0;
    ordinates.cwiseAbs().maxCoeff(&at);
    return at == ordinates.size() - 1;
  }

  std::vector<std::string> doubts_of(const CalibrationFile &file, const CalibrationRuns &runs)
  {
    std::vector<std::string> found;
    bool                     curves = false;
    for (std::size_t k = 0; k < file.targets.size(); ++k)
      {
        const CalibrationTarget &target = file.targets[k];
        const Eigen::Index       first = runs.first_of(k), points = runs.first_of(k + 1) - first;
        if (!target.is_curve() || points < 2)
          continue;
        curves = true;
        if (ends_at_its_peak(runs.measured().segment(first, points)))
          found.push_back("The curve of target " + target.name +
                          " ends at its peak: of a strength it says only that it is not less, and errors of constants "
                          "that decide it are larger than their bars. Give the strength as a figure beside it.");
      }
    if (curves && file.model_noise == optimisation::NoiseSearch::never)
      found.push_back("Bars take runs for smooth in the constants, as Search/Model noise = false says. Where links "
                      "break they scatter, and bars are several times too narrow; \"automatic\" finds that out.");
    return found;
  }
} // namespace apps
