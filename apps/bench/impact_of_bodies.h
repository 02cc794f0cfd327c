#pragma once

#include "apps/bench/impact.h"
#include "apps/process/progress.h"
#include "apps/runs/continuum/model.h"

namespace apps
{
  /**
   * Options of a bench of colliding balls of finite elements: their elements, with a contact that grows stiffer by the fourth power of their number
   * (doc/tutorials/colliding_balls.md), and for one of these meshes the step and the stiffness alone. @pre explicit, with balls and one contact
   */
  std::vector<SceneVariant> impacts_of_bodies(const ContinuumModel &model, bool quick);

  /** Compute one. Unfinished where the user has interrupted. @throws as a run of the scene */
  ImpactMeasurement measure_bodies(const ContinuumModel &model, const SceneVariant &which, Progress &progress);
} // namespace apps
