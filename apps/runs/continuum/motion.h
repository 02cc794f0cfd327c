#pragma once

#include "apps/runs/continuum/energy.h"
#include "apps/runs/continuum/model.h"
#include "base/state.h"
#include "fem/explicit/explicit_solver.h"

#include <cstdint>

namespace apps
{
  /**
   * The motion of a solid as a scene describes it: densities, damping, safety and initial velocity.
   * @param solid must outlive it. @param gravity acceleration of what falls [m/s^2]. @throws base::InputError
   */
  template <int dim>
  std::unique_ptr<fem::ExplicitSolver<dim>>
  make_motion(fem::Solid<dim> &solid, const ContinuumModel &model, const std::array<double, 3> &gravity = {0, 0, 0});

  /** How many steps of this length [s] a motion takes. @throws base::InputError for more than ever end */
  std::int64_t steps_of(const MotionSection &motion, double length);

  /** The first of equal steps that end together after a rest, none longer than the longest [s]. */
  double step_towards(double rest, double longest);

  /** The account of a motion, without what materials store. */
  ContinuumEnergy energy_of(const fem::ExplicitEnergy &motion);

  /** All that a motion needs to go on to the same bits, histories of the points included. Columns hold this rank's part. */
  template <int dim>
  void visit_motion(base::StateVisitor &visitor, fem::ExplicitSolver<dim> &motion, fem::Solid<dim> &solid);
} // namespace apps
