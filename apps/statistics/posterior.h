#pragma once

#include "apps/statistics/emulator.h"
#include "apps/statistics/ensemble_sampler.h"

namespace statistics
{
  /** What was observed of the outputs of an emulator, and how surely. */
  struct Observed
  {
    Eigen::VectorXd outputs;
    double          scatter = 0; ///< standard deviation of each; 0: not known, and found with the constants
  };

  /** Constants as probable as observations make them that every place of a box was before. */
  struct Posterior
  {
    Eigen::MatrixXd constants;    ///< a row for each draw
    Eigen::MatrixXd outputs;      ///< of the emulator, of some draws
    double          accepted = 0; ///< share of the sampler's moves
    double          drift =
      0; ///< between the means of both halves of the draws, over their standard deviation, of the worst constant

    Eigen::VectorXd mean() const { return constants.colwise().mean(); }
    Eigen::VectorXd standard_deviation() const;
    /** Ends of the interval in the middle that holds a constant with the probability. */
    std::pair<Eigen::VectorXd, Eigen::VectorXd> band(double probability) const;
    /** The same of the outputs, without the scatter of a single observation. */
    std::pair<Eigen::VectorXd, Eigen::VectorXd> band_of_outputs(double probability) const;
  };

  /**
   * By the sampler, with the emulator's own error counted as one of the observations (doc/theory/studies.md, 11). Constants are equally
   * probable within the emulator's box, and so is the logarithm of an unknown scatter.
   * @throws base::InputError for another number of outputs
   */
  Posterior posterior(const Emulator &emulator, const Observed &observed, const EnsembleOptions &options = {});
} // namespace statistics
