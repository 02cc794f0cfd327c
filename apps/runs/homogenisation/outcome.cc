#include "apps/runs/homogenisation/outcome.h"

#include <fmt/format.h>

namespace apps
{
  RunOutcome outcome(const HomogenisationModel &model)
  {
    RunOutcome found;
    for (std::size_t k = 0; k < model.interaction_ratios.size() * model.shear_ratios.size(); ++k)
      for (const HomogenisationWay &way : homogenisation_ways)
        for (const char *constant : {"young_modulus", "poisson_ratio"})
          found.figures.push_back(fmt::format("cases/{}/{}/{}", k, way.name, constant));
    return found;
  }
} // namespace apps
