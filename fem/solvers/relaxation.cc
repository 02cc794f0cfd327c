// Static steps where no equilibrium lies near: dampers give way until there is one (doc/theory/static-solver.md, 4).
#include "base/number_text.h"
#include "fem/mesh/extent.h"
#include "fem/solvers/static_solver.h"

#include <algorithm>

namespace fem
{
  using namespace dealii;

  namespace
  {
    // A damper as stiff as the solid halves its way in a step; a thousandth no longer holds it. Beyond a million times as stiff
    // nothing moves, and a step that still fails has another reason.
    constexpr double       stiffest   = 1e6;
    constexpr unsigned int most_steps = 300, easy_iterations = 6;
    constexpr double       softer = 0.5, stiffer = 4;
    constexpr double       runaway = 0.02; // way over the size of the solid, beyond what small strains are good for
  }

  template <int dim>
  StepReport StaticSolver<dim>::relax_to(const double time)
  {
    StepReport report = advance_to(time);
    if (report.converged || solid.linear())
      return report;
    const StaticState  before = state();
    const base::Column points = solid.saved_points();
    report                    = relax(time);
    damper                    = 0;
    if (!report.converged)
      {
        solid.restore_points(points);
        restore(before);
      }
    return report;
  }

  template <int dim>
  StepReport StaticSolver<dim>::relax(const double time)
  {
    double at_hand = std::max(f_ext.l2_norm(), f_int.l2_norm()); // a solid that lets go has no force left at the end
    Vector r = solid.make_vector(), start = u;
    double share = 1, stiffness = 0;
    StepReport total;
    for (total.relaxed = 1; total.relaxed <= most_steps; ++total.relaxed)
      {
        Trial trial{u, f_int, f_ext, time};
        trial.u.update_ghost_values();
        if (stiffness == 0)
          {
            damper = 0;
            linearise(trial, nullptr, nullptr);
            stiffness = tangent.linfty_norm();
          }
        damper_from             = u;
        damper                  = share * stiffness;
        const StepReport report = finish_or_fail(attempt(trial, 0.0), trial);
        total.iterations += report.iterations;
        total.residual = report.residual;
        total.reason   = report.reason;
        if (!report.converged)
          {
            share *= stiffer;
            if (share > stiffest)
              return total;
            continue;
          }
        damper = 0;
        unbalance({u, f_int, f_ext, time}, r);
        total.converged = balanced({u, f_int, f_ext, time}, r, at_hand, total);
        if (total.converged)
          return total;
        r = u;
        r -= start;
        if (r.linfty_norm() > runaway * extent_of(solid.mesh()).diagonal())
          {
            total.reason = "the solid falls apart: it has moved by " + base::number_text(r.linfty_norm()) + " m.";
            return total;
          }
        if (report.iterations <= easy_iterations)
          share *= softer;
      }
    total.reason = "the relaxation found no rest in " + std::to_string(most_steps) + " damped steps (unbalanced " +
                   base::number_text(total.residual) + ").";
    return total;
  }

  template StepReport StaticSolver<2>::relax_to(double);
  template StepReport StaticSolver<3>::relax_to(double);
}
