#pragma once

#include "apps/statistics/gaussian_process.h"

namespace statistics
{
  /** Runs of a model with several outputs: a row of constants and a row of outputs each. */
  struct ModelRuns
  {
    std::vector<std::string> names; ///< of the constants
    Eigen::MatrixXd          constants, outputs;
  };

  /**
   * Stands for a costly model with many outputs: the principal components of the outputs of its runs, a Gaussian process for each (Higdon,
   * Gattiker, Williams and Rightley 2008; doc/theory/studies.md, 11).
   */
  class Emulator
  {
  public:
    struct Outputs
    {
      Eigen::VectorXd mean;
      Eigen::VectorXd variances; ///< of each component
    };

    /** @throws base::InputError below 3 or above 300 runs, for outputs that do not vary, or constants that do not */
    explicit Emulator(const ModelRuns &runs);

    Outputs                at(const Eigen::VectorXd &constants) const;
    const Eigen::MatrixXd &components() const { return directions; } ///< orthonormal columns
    const Box             &box() const { return processes.front().box(); }

    /** Mean square of an output that the components leave out. */
    double left_over() const { return truncated; }
    /** Root mean square of what the emulator of all other runs misses, over the outputs. */
    double error() const { return left_out_error; }

  private:
    Eigen::VectorXd              mean;
    Eigen::MatrixXd              directions;
    std::vector<GaussianProcess> processes;
    double                       truncated = 0, left_out_error = 0;
  };
} // namespace statistics
