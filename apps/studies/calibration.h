#pragma once

#include "apps/optimisation/least_squares_search.h"
#include "apps/statistics/uncertainty.h"
#include "apps/studies/calibration_runs.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** How probable constants are, by an emulator of runs around the answer (doc/theory/studies.md, 11). */
  struct CalibrationPosterior
  {
    Eigen::Index    runs = 0;                               ///< with an answer
    Eigen::VectorXd mean, standard_deviation, lower, upper; ///< bands of 95 %
    Eigen::VectorXd lowest, highest;                        ///< of what was measured; bands of 95 % without its scatter
    double          emulator_error = 0, scatter = 0;        ///< root mean squares, in the scales of the targets
    double          accepted = 0, drift = 0;                ///< of the sampler

    std::vector<std::string> warnings;
  };

  /** Constants that make runs give what was measured, and how sure they are. */
  struct Calibration
  {
    Eigen::VectorXd   constants, standard_errors; ///< errors: NaN where there are none
    Eigen::VectorXd   lower, upper;               ///< of the bands of 95 %, within the bounds; NaN likewise
    std::vector<bool> determined;
    Eigen::MatrixXd   correlation;
    double            condition = 0;
    Eigen::VectorXd   at_start;               ///< what the constants of the start give; empty where that was not run
    Eigen::VectorXd   predicted, half_widths; ///< for what was measured; bands of 95 %
    double            relative_sum = 0;       ///< sum of squared deviations over squared targets, in their scales
    int               evaluations = 0, failed = 0;
    double            noise     = 0;     ///< of runs between neighbouring constants, over the deviation of a residual
    bool              noisy     = false; ///< so much that bars, bands and the answer take account of it
    bool              smoothed  = false; ///< the answer is not one run's, but of many together
    bool              astray    = false; ///< many runs together lead to a worse answer than the search
    bool              cut_short = false; ///< its last step took more sets of constants than were left
    std::string       ending;
    int               cheap_evaluations = 0; ///< of the cheap model, before

    std::optional<CalibrationPosterior> posterior;

    std::vector<std::string> warnings; ///< sentences
  };

  /**
   * Bounded least squares over runs, of a cheap model first if there is one; constants that the data do not determine, or no better than
   * their bounds do, go back to their start and are held, and the others are sought again (doc/theory/studies.md, 9 to 11).
   * @param cheap nullptr: there is none @throws base::InputError, CalibrationInterrupted
   */
  Calibration calibrate(const CalibrationFile &file, CalibrationRuns &runs, CalibrationRuns *cheap = nullptr);

  /** @throws base::InputError where too few runs have an answer; CalibrationInterrupted */
  CalibrationPosterior posterior_of(const CalibrationFile &file, CalibrationRuns &runs, const Calibration &found);

  /** Those of the search and those of the posterior. */
  std::vector<std::string> warnings_of(const Calibration &found);

  /** What calibration.json holds (doc/formats.md). */
  nlohmann::json json_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found);
  /** constants.prm: the constants as part of a scene, to be copied into it. */
  std::string prm_of(const CalibrationFile &file, const Calibration &found);

  /** What a terminal shows. */
  std::string words_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found);
  /** Draw TARGET.png of each curve, and report.html with them. What cannot be drawn costs a warning. */
  void write_report(const CalibrationFile       &file,
                    const CalibrationRuns       &runs,
                    const Calibration           &found,
                    const std::filesystem::path &folder);
  /** TARGET.csv of a curve: measured, predicted, half width of its band, and the posterior's band if there is one. */
  std::string
  curve_csv_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found, std::size_t target);
} // namespace apps
