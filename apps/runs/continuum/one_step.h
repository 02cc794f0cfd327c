#pragma once

#include "apps/runs/continuum/model.h"
#include "fem/solid/solid.h"

namespace apps
{
  /**
   * Whether a static analysis without a step of its own needs but one: the solid is linear, and its loads and prescribed displacements go
   * straight from the start to the end, so that every state between is a mean of these two. All ranks together.
   */
  template <int dim>
  bool one_step_does(const fem::Solid<dim> &solid, const ControlSection &control);
} // namespace apps
