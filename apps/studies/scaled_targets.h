#pragma once

#include "apps/studies/inversion.h"
#include "apps/studies/run_study.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /** How an inversion is checked by runs, and repeated until these give what was wanted. */
  struct TargetScaling
  {
    std::string  study; ///< file: its factors of the surfaces' names take the constants found, others, a seed, stay
    double       tolerance   = 0.05; ///< of the mean of its runs, over the target
    std::int64_t most_rounds = 4;
    StudyOptions options; ///< its folder holds one of each round
  };

  /** Constants found, and what runs with them give. */
  struct ScaledRound
  {
    std::vector<double> requested; ///< of each surface
    Inversion           found;
    std::vector<double> means, variations; ///< of each response over the runs: mean, standard deviation over mean
    Eigen::Index        runs = 0;          ///< that have all responses
  };

  struct ScaledTargets
  {
    std::vector<ScaledRound> rounds;
    bool                     interrupted = false, within_tolerance = false;
  };

  /**
   * Surfaces err, and are of the packings that they were made with: constants are inverted, run, and where a mean is off the target, that of
   * its surface is multiplied by target over mean, and so on (doc/theory/studies.md, 6).
   * @param on_round called with each round as it ends
   * @throws base::InputError for a study without a factor or a response of the surfaces, and where no run has all responses
   */
  ScaledTargets scale_targets(const InversionQuestion                        &question,
                              const TargetScaling                            &scaling,
                              const std::function<void(const ScaledRound &)> &on_round);
} // namespace apps
