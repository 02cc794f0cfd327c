#pragma once

#include "fem/solvers/static_solver.h"

#include <functional>

namespace fem
{
  /// How steps shrink and grow. Lengths are in time, or in the controlled displacement under path control.
  struct StepControl
  {
    double       first    = 0.1;
    double       smallest = 1e-6;
    double       largest  = 0.1;
    unsigned int easy     = 6;   ///< iterations up to which the next step may grow
    double       growth   = 1.5; ///< after an easy step
    bool         relax =
      false; ///< a step that would be cut below a quarter of the first relaxes over it instead (not under path control)
  };

  /// Called after every accepted step; false ends the run.
  using StepObserver = std::function<bool(const StepReport &, double length)>;

  /// A step as short as allowed found no equilibrium. The solver stands at the last accepted one.
  class NoEquilibrium : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Goes to `end` in steps that are halved when they fail. @throws NoEquilibrium
  /// @param length of the next step, kept up to date: what a resumed run starts with to go on to the same bits.
  template <int dim>
  void
  run_to(StaticSolver<dim> &solver, double end, const StepControl &steps, double &length, const StepObserver &observe);

  /// The same, starting with steps.first.
  template <int dim>
  void run_to(StaticSolver<dim> &solver, double end, const StepControl &steps, const StepObserver &observe);

  /// Goes along the path until the observer ends it. @throws NoEquilibrium
  /// @param length as above.
  template <int dim>
  void run_along(StaticSolver<dim>  &solver,
                 const PathControl  &control,
                 const StepControl  &steps,
                 double             &length,
                 const StepObserver &observe);

  /// The same, starting with steps.first.
  template <int dim>
  void run_along(StaticSolver<dim>  &solver,
                 const PathControl  &control,
                 const StepControl  &steps,
                 const StepObserver &observe);
}
