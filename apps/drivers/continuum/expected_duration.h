#pragma once

#include "apps/drivers/continuum/model.h"

namespace apps
{
  /** Steps of a static analysis, if none is cut. */
  double states_of(const ContinuumModel &model);

  /**
   * Seconds that so many new states take: steps, or samples of an explicit motion. The first ones are computed. Steps of a material that is
   * not damaged yet need few iterations; later ones are taken to need as many as cracking usually does.
   * @throws base::InputError for what a run refuses in its first steps; what solvers throw, where these find no equilibrium
   */
  template <int dim>
  double expected_seconds(const ContinuumModel &model, double states);
} // namespace apps
