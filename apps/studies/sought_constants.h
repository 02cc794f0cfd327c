#pragma once

#include "apps/optimisation/model_noise.h"
#include "apps/studies/calibration_runs.h"

#include <optional>
#include <vector>

namespace apps
{
  /** The constants of a calibration that are sought, among all: the others are held. */
  class SoughtConstants
  {
  public:
    /** All are sought, from their starts. */
    SoughtConstants(const CalibrationFile &file, CalibrationRuns &runs);

    const std::vector<int> &kept() const { return sought; } ///< numbers of those that are sought
    const Eigen::VectorXd  &constants() const { return all; }
    Eigen::VectorXd         ranges() const;

    void hold_at_start(const std::vector<int> &held);
    /** Those that were held are sought as well. */
    void seek_again(const std::vector<int> &held);
    /** Where another model has its answer, with its derivatives. */
    void begin_at(const SoughtConstants &other);

    /** Where they are now, as if a search had ended there; nothing where that has no answer. @throws as CalibrationRuns::predicted() */
    std::optional<optimisation::LeastSquaresFit> here();
    /** Search from where they are now. @throws as CalibrationRuns::predicted() */
    optimisation::LeastSquaresFit fit(const optimisation::LeastSquaresOptions &options);
    /** The end of that search, put right where the noise of the runs matters. @param fit what fit() has found @throws likewise */
    optimisation::ModelAtEnd at_end(const optimisation::LeastSquaresOptions &options,
                                    const optimisation::LeastSquaresFit     &fit,
                                    const optimisation::NoiseOptions        &noise);

  private:
    optimisation::LeastSquaresProblem problem();

    const CalibrationFile &file;
    CalibrationRuns       &runs;
    Eigen::VectorXd        all;
    std::vector<int>       sought;
    Eigen::MatrixXd        known_jacobian; ///< where the last search ended; empty: there was none
  };
} // namespace apps
