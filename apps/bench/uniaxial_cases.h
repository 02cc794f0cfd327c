#pragma once

#include "apps/runs/uniaxial/model.h"

#include <string>
#include <vector>

namespace apps
{
  /** One model of a study: what is varied, and by how much. */
  struct UniaxialCase
  {
    std::string study; ///< "time step", "loading rate" or "particle size"
    double      value; ///< of the varied quantity
    std::string unit;
    bool        reference = false; ///< the errors of the study are against this case

    /** The model of the scene with this case's value. */
    UniaxialModel apply(UniaxialModel model) const;
  };

  /**
   * Time step factors 0.1 to 0.95, rates from 1/10 to 10 times the scene's, radii 0.75 to 2 times the scene's
   * particle radius.
   * @param quick leaves out the cases that cost most; each study keeps a reference.
   */
  std::vector<UniaxialCase> uniaxial_cases(bool quick);
} // namespace apps
