#include "fem/solvers/static_solver.h"

#include "base/number_text.h"

#include <Eigen/Eigenvalues>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <limits>
#include <vector>

namespace fem
{
  using namespace dealii;

  namespace
  {
    // Rounding of the forces may stop the iteration above the tolerance (elements of aspect 1 : 1000 leave 4e-4), but not a
    // solid that has run away to displacements so large that any force is rounding.
    constexpr double worst_rounding = 1e-3;
  }

  template <int dim>
  StaticSolver<dim>::StaticSolver(Solid<dim> &solid_, const NewtonOptions &newton_, const LinearSolverOptions &linear_)
    : solid(solid_)
    , options(newton_)
    , linear(make_linear_solver(solid_, linear_, solid_.linear()))
    , u(solid_.make_vector())
    , f_int(solid_.make_vector())
    , f_ext(solid_.make_vector())
    , last_step(solid_.make_vector())
  {
    if (linear->wants_matrix())
      solid.make_matrix(tangent);
    solid.internal_force(u, f_int);
    f_int.update_ghost_values();
  }

  template <int dim>
  double StaticSolver<dim>::measure(const PathControl &control, const Vector &of) const
  {
    double sum = 0;
    for (const auto &[dof, weight] : control.weights)
      sum += weight * of[dof];
    return Utilities::MPI::sum(sum, solid.communicator());
  }

  template <int dim>
  bool StaticSolver<dim>::balanced(const Trial &trial, const Vector &r, double &scale, StepReport &report) const
  {
    // Against the forces at hand and those that the prescribed step itself brings (a solid on its way to a stress-free state
    // has none at its end), not against what an iteration that goes astray passes through.
    const double now = std::max({scale, trial.f_ext.l2_norm(), trial.f_int.l2_norm(), 1e-300});
    if (scale == 0)
      scale = now;
    const double size    = r.l2_norm();
    const double rounded = std::numeric_limits<double>::epsilon() * tangent_size * trial.u.l2_norm();
    report.residual      = size / now;
    if (options.on_iteration && report.iterations > 0) // before, what the supports will bring is not in it
      options.on_iteration(report.iterations, report.residual / options.tolerance);
    if (!std::isfinite(size))
      throw MaterialFailure("the unbalanced force is not a number.");
    if (size <= options.tolerance * now)
      return true;
    report.rounded = size <= rounded && report.residual <= worst_rounding;
    return report.rounded;
  }

  template <int dim>
  void StaticSolver<dim>::set_tangent()
  {
    if (tangent_known && solid.linear())
      return;
    if (linear->wants_matrix())
      linear->set_matrix(tangent);
    tangent_size  = linear->wants_matrix() ? tangent.linfty_norm() : linear->matrix_size();
    tangent_known = true;
  }

  template <int dim>
  void StaticSolver<dim>::linearise(Trial &trial, const Vector *direction, Vector *product)
  {
    if (solid.linear() && (tangent_known || !linear->wants_matrix()))
      {
        solid.internal_force(trial.u, trial.f_int);
        if (direction) // stress is linear in displacement: the force of the direction is the product
          solid.internal_force(*direction, *product);
        return;
      }
    Sweep wanted;
    wanted.internal_force = &trial.f_int;
    wanted.tangent        = &tangent;
    if (direction)
      wanted.products = {{direction, product}};
    solid.sweep(trial.u, wanted);
    if (damper > 0)
      {
        for (auto i = tangent.local_range().first; i < tangent.local_range().second; ++i)
          tangent.add(i, i, damper);
        tangent.compress(VectorOperation::add);
      }
  }

  template <int dim>
  void StaticSolver<dim>::unbalance(const Trial &trial, Vector &r) const
  {
    r = trial.f_ext;
    r -= trial.f_int;
    if (damper > 0)
      r.add(-damper, trial.u, damper, damper_from);
    solid.constraints().set_zero(r);
  }

  template <int dim>
  StepReport StaticSolver<dim>::advance_to(const double time, const unsigned int trusted)
  {
    Trial      trial{u, f_int, f_ext, time};
    StepReport report;
    // Where damage has localised, the last step knows the shape of the next one better than any tangent at its start.
    if (!solid.linear() && last_length > 0)
      report = trusted_attempt(trial, (time - current_time) / last_length, trusted);
    if (!report.converged)
      {
        trial  = {u, f_int, f_ext, time};
        report = trusted_attempt(trial, 0.0, trusted);
      }
    return finish_or_fail(report, trial);
  }

  template <int dim>
  StepReport StaticSolver<dim>::trusted_attempt(Trial &trial, const double extrapolation, const unsigned int trusted)
  {
    StepReport report = attempt(trial, extrapolation);
    if (report.converged && report.iterations > trusted && !solid.linear() && !stable())
      {
        report.converged = false;
        report.reason    = "the equilibrium found after " + std::to_string(report.iterations) +
                        " iterations is not stable: the way there leads to another one.";
      }
    return report;
  }

  template <int dim>
  bool StaticSolver<dim>::stable()
  {
    // Arnoldi's method for the inverse of the tangent, from a vector that favours no motion. What localises is weak: it is found
    // among the first few motions, as an end of the spectrum. For y = K^-1 x the tangent does the work x . y.
    constexpr int    motions   = 16;
    constexpr double rounding  = 1e-9; // of the largest eigenvalue of the inverse
    Eigen::MatrixXd  projected = Eigen::MatrixXd::Zero(motions, motions);
    try
      {
        set_tangent();
        std::vector<Vector> basis;
        Vector              x = solid.make_vector(), y = solid.make_vector();
        for (const auto i : x.locally_owned_elements())
          x[i] = std::sin(1.0 + static_cast<double>(i));
        solid.constraints().set_zero(x);
        int found = 0;
        for (double length = x.l2_norm(); found < motions && length > 0; ++found)
          {
            x /= length;
            basis.push_back(x);
            linear->solve(y, x);
            solid.constraints().set_zero(y);
            const double size = y.l2_norm();
            for (int k = 0; k <= found; ++k)
              {
                projected(k, found) = basis[k] * y;
                y.add(-projected(k, found), basis[k]);
              }
            length = y.l2_norm();
            if (length <= 1e-12 * size)
              length = 0;
            if (found + 1 < motions)
              projected(found + 1, found) = length;
            x = y;
          }
        const Eigen::MatrixXd                                inverse = projected.topLeftCorner(found, found);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (inverse + inverse.transpose()),
                                                                   Eigen::EigenvaluesOnly);
        return found == 0 || modes.eigenvalues()[0] > -rounding * modes.eigenvalues().cwiseAbs().maxCoeff();
      }
    catch (const MaterialFailure &)
      {
        return true; // a tangent that cannot be solved with says nothing
      }
  }

  template <int dim>
  StepReport StaticSolver<dim>::attempt(Trial &trial, const double extrapolation)
  {
    try
      {
        trial.u.add(extrapolation, last_step);
        trial.u.update_ghost_values();
        return newton(trial);
      }
    catch (const MaterialFailure &failure)
      {
        StepReport report;
        report.reason = failure.what();
        return report;
      }
  }

  template <int dim>
  StepReport StaticSolver<dim>::finish_or_fail(const StepReport &report, const Trial &trial)
  {
    if (!report.converged)
      return report;
    work.dissipated.add(solid.dissipated());
    solid.commit();
    last_step = trial.u;
    last_step -= u;
    // Trapezoidal work. On supported displacements the force is the reaction plus the load, that is the internal force.
    Vector mean = trial.f_int;
    mean += f_int;
    work.internal += 0.5 * (mean * last_step);
    Vector outer = trial.f_ext;
    outer += f_ext;
    mean -= outer;
    Vector reaction = mean;
    solid.constraints().set_zero(reaction);
    mean -= reaction; // what remains acts on supported displacements only
    work.external += 0.5 * (outer * last_step + mean * last_step);
    if (damper > 0)
      work.damped -= 0.5 * (reaction * last_step);

    u            = trial.u;
    f_int        = trial.f_int;
    f_ext        = trial.f_ext;
    last_length  = trial.time - current_time;
    current_time = trial.time;
    u.update_ghost_values();
    f_int.update_ghost_values();
    f_ext.update_ghost_values();
    last_step.update_ghost_values();
    return report;
  }

  template <int dim>
  StepReport StaticSolver<dim>::newton(Trial &trial)
  {
    StepReport report;
    solid.begin_step();
    double scale            = 0;
    Vector step_of_supports = solid.make_vector(), carried = solid.make_vector(), r = solid.make_vector(),
           d = solid.make_vector();
    solid.prescribed(trial.time, step_of_supports);
    {
      Vector held = trial.u;
      solid.constraints().set_zero(held);
      held -= trial.u; // less the supported part
      step_of_supports += held;
      step_of_supports.update_ghost_values();
    }
    solid.external_force(trial.time, trial.f_ext);

    for (unsigned int iteration = 0; iteration <= options.iterations; ++iteration)
      {
        linearise(trial, iteration == 0 ? &step_of_supports : nullptr, &carried);
        unbalance(trial, r);
        report.iterations = iteration;
        report.converged  = balanced(trial, r, scale, report) && iteration > 0;
        if (report.converged)
          return report;
        if (iteration == options.iterations)
          break;
        if (iteration == 0)
          {
            solid.constraints().set_zero(carried);
            r -= carried;
            scale = std::max(scale, carried.l2_norm());
          }
        set_tangent();
        linear->solve(d, r);
        solid.constraints().set_zero(d);
        if (iteration == 0)
          {
            d += step_of_supports;
            trial.u += d;
            trial.u.update_ghost_values();
          }
        else
          update_with_line_search(trial, d, r.l2_norm());
      }
    report.reason = "no equilibrium after " + std::to_string(options.iterations) + " iterations (unbalanced " +
                    base::number_text(report.residual) + ").";
    return report;
  }

  template <int dim>
  void StaticSolver<dim>::update_with_line_search(Trial &trial, const Vector &direction, const double unbalanced)
  {
    // Full step unless it raises the unbalanced force; then the best of a few shorter ones. (Softening makes the tangent
    // indefinite, so the work of the force on the step says nothing.)
    const Vector start = trial.u;
    const auto   go    = [&](const double a) {
      trial.u = start;
      trial.u.add(a, direction);
      trial.u.update_ghost_values();
    };
    if (!options.line_search)
      return go(1);
    Vector r      = solid.make_vector();
    double best_a = 1, best = std::numeric_limits<double>::max();
    for (const double a : {1.0, 0.5, 0.25, 0.1})
      {
        go(a);
        try
          {
            solid.internal_force(trial.u, trial.f_int);
            unbalance(trial, r);
            const double size = r.l2_norm();
            if (size < unbalanced)
              return;
            if (size < best)
              {
                best   = size;
                best_a = a;
              }
          }
        catch (const MaterialFailure &)
          {
          }
      }
    go(best_a);
  }

  template <int dim>
  Tensor<1, dim> StaticSolver<dim>::reaction(const std::string &boundary) const
  {
    Tensor<1, dim> sum;
    for (unsigned int c = 0; c < dim; ++c)
      {
        ComponentMask mask(dim, false);
        mask.set(c, true);
        const IndexSet on_boundary =
          DoFTools::extract_boundary_dofs(solid.dofs(), mask, {solid.mesh().boundary(boundary)});
        double part = 0;
        for (const types::global_dof_index dof : on_boundary)
          if (u.in_local_range(dof))
            part += f_int[dof] - f_ext[dof];
        sum[c] = Utilities::MPI::sum(part, solid.communicator());
      }
    return sum;
  }

  template <int dim>
  StaticState StaticSolver<dim>::state() const
  {
    return {current_time, last_length, work, u, last_step, f_int};
  }

  template <int dim>
  void StaticSolver<dim>::restore(const StaticState &saved)
  {
    current_time = saved.time;
    last_length  = saved.last_length;
    work         = saved.energy;
    u            = saved.displacement;
    last_step    = saved.last_step;
    f_int        = saved.internal_force;
    for (Vector *v : {&u, &last_step, &f_int})
      v->update_ghost_values();
    solid.external_force(current_time, f_ext);
  }

  template class StaticSolver<2>;
  template class StaticSolver<3>;
}
