#pragma once

#include "apps/optimisation/genetic_search.h"
#include "apps/studies/stored_surface.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** What constants shall give, and where they may lie. */
  struct InversionQuestion
  {
    std::vector<StoredSurface>                       surfaces;
    std::vector<double>                              targets; ///< of each surface
    std::map<std::string, std::pair<double, double>> box;     ///< instead of where all surfaces of a factor were fitted
    bool                         over_prediction = false;     ///< deviations relative to the surface, not to the target
    int                          starts          = 5;
    optimisation::GeneticOptions genetic;
  };

  /** Constants, and what the surfaces give for them. */
  struct InversionSolution
  {
    Eigen::VectorXd constants, responses;
    double          misfit = 0; ///< sum of the magnitudes of relative deviations
  };

  /** Constants that meet the targets best. */
  struct Inversion
  {
    std::vector<std::string>       factors;
    statistics::Box                box;
    std::vector<InversionSolution> equally_good;    ///< the most central one in the box first
    bool                           reached = false; ///< all targets, to 1e-6
    std::vector<std::string>       warnings;        ///< sentences

    const InversionSolution &best() const { return equally_good.front(); }
  };

  /**
   * Genetic search from several starts, polished by bounded least squares; and other answers that are as good, polished from places all
   * over the box (doc/theory/studies.md, 6).
   * @throws base::InputError for a target of zero, a box without room or of a factor that no surface has
   */
  Inversion invert(const InversionQuestion &question);
} // namespace apps
