#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace statistics
{
  struct EnsembleOptions
  {
    int           steps     = 2000; ///< of each walker that are kept
    int           forgotten = 500;  ///< before these
    std::uint64_t seed      = 1;
  };

  /** Places that a sampler found, as often as they are probable. */
  struct Ensemble
  {
    Eigen::MatrixXd places;       ///< a row each, all walkers of a step after each other
    double          accepted = 0; ///< share of the moves
  };

  /**
   * Draws from a density by the stretch moves of Goodman and Weare (2010), which no linear map of the variables changes: what is
   * strongly correlated needs no tuning (doc/theory/studies.md, 11). The same seed gives the same bits.
   * @param log_density up to a constant; -infinity where it is impossible
   * @param starts a row for each walker: an even number, at least twice as many as variables, not all in one plane, all possible
   * @throws base::InputError for other starts
   */
  Ensemble sampled(const std::function<double(const Eigen::VectorXd &)> &log_density,
                   const Eigen::MatrixXd                                &starts,
                   const EnsembleOptions                                &options);

  /** The value that a share of them does not exceed, by linear interpolation in their order. */
  double quantile(const Eigen::VectorXd &values, double share);
} // namespace statistics
