#pragma once

#include "apps/runs/continuum/run.h"

#include <string>

namespace apps
{
  /** Steps of a static analysis, if none is cut. */
  template <int dim>
  double states_of(const fem::Solid<dim> &solid, const ContinuumModel &model);

  /** What is known of a run before it is executed. */
  struct ExpectedRun
  {
    double      seconds = 0;     ///< until its last state
    double      states  = 0;     ///< that were tried
    bool        whole   = false; ///< it was tried to its end
    std::string failure;         ///< what ended it; "": nothing did
  };

  /**
   * Expected of so many new states: steps, or samples of an explicit motion. The first ones are computed, and more for a run that a stop
   * condition may end. Steps of a material that is not damaged yet need few iterations; later ones are taken to need as many as
   * cracking usually does.
   * @param run that is not executed any more
   * @throws base::InputError for what a run refuses in its first steps; StoppedShort, where these find no equilibrium
   */
  template <int dim>
  ExpectedRun expected(ContinuumRun<dim> &run, const ContinuumModel &model, double states);
} // namespace apps
