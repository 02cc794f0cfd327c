#include "apps/process/progress.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/one_step.h"
#include "apps/runs/continuum/solid.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    /** @param on_iteration how far it is */
    fem::NewtonOptions newton_options(const ControlSection                     &control,
                                      std::function<void(unsigned int, double)> on_iteration)
    {
      fem::NewtonOptions options;
      options.on_iteration = std::move(on_iteration);
      options.tolerance    = control.tolerance;
      options.iterations   = static_cast<unsigned int>(control.iterations);
      options.line_search  = control.line_search;
      return options;
    }

    fem::LinearSolverOptions linear_options(const ControlSection &control)
    {
      fem::LinearSolverOptions options;
      options.tolerance = control.linear_tolerance;
      options.method    = control.linear_solver == ControlSection::LinearSolver::direct    ? fem::LinearMethod::direct :
                          control.linear_solver == ControlSection::LinearSolver::iterative ? fem::LinearMethod::iterative :
                                                                                             fem::LinearMethod::automatic;
      return options;
    }

    const NamedPoint &point_named(const ContinuumModel &model, const std::string &name)
    {
      return **std::find_if(model.loads.points.begin(), model.loads.points.end(),
                            [&](const auto &point) { return point->name == name; });
    }

    /** The opening between two points along a direction, as weights of displacements. */
    template <int dim>
    fem::PathControl opening_control(const fem::Solid<dim> &solid, const ContinuumModel &model)
    {
      const dealii::Point<dim> from    = point_of<dim>(point_named(model, model.control.opening_from).position),
                               to      = point_of<dim>(point_named(model, model.control.opening_to).position);
      dealii::Tensor<1, dim> direction = point_of<dim>(model.control.direction);
      if (direction.norm() == 0)
        direction = to - from;
      if (direction.norm() == 0)
        throw base::InputError(
          "Control/Direction = 0, 0, 0: the two points of the opening coincide, so that it must be "
          "given.");
      direction /= direction.norm();
      fem::PathControl control;
      for (unsigned int c = 0; c < dim; ++c)
        if (direction[c] != 0)
          for (const auto &[place, sign] : {std::make_pair(from, -1.0), std::make_pair(to, 1.0)})
            for (const auto &[dof, weight] : solid.interpolation(place, c))
              control.weights.emplace_back(dof, sign * direction[c] * weight);
      return control;
    }

    template <int dim>
    class StaticAnalysis : public ContinuumAnalysis<dim>
    {
    public:
      StaticAnalysis(fem::Solid<dim> &solid_, const ContinuumModel &model)
        : solid(solid_)
        , control(model.control)
        , solver(solid_,
                 newton_options(
                   model.control,
                   [this](const unsigned int iteration, const double over) { show_iteration(iteration, over); }),
                 linear_options(model.control))
        , first(one_step_does(solid_, model.control) ? model.control.end : model.control.first())
        , length(first)
      {
        if (control.follow == ControlSection::Follow::indirect)
          path = opening_control(solid, model);
        else
          path.kind = fem::PathControl::Kind::cylindrical;
      }

      bool finished() const override { return accepted >= control.most_steps || coordinate() >= end() * (1 - 1e-12); }

      bool advance() override
      {
        fem::StepControl steps;
        steps.first    = first;
        steps.smallest = control.smallest();
        steps.largest  = std::max(first, control.largest());
        steps.growth   = control.growth;
        steps.easy     = static_cast<unsigned int>(control.easy_iterations);
        steps.relax    = control.relax;
        const base::Stopwatch watch;
        const Speaking        speaking(working);
        const auto            one = [&](const fem::StepReport &report, const double done) {
          ++accepted;
          iterations += report.iterations;
          rounded += report.rounded ? 1 : 0;
          relaxed += report.relaxed > 0 ? 1 : 0;
          report_of_last = report;
          travelled += done;
          return false;
        };
        if (control.follow == ControlSection::Follow::time)
          fem::run_to(solver, control.end, steps, length, one);
        else
          fem::run_along(solver, path, steps, length, one);
        seconds += watch.seconds();
        return true;
      }

      SolidState state() const override
      {
        return {&solver.displacement(), &solver.internal_force(), &solver.external_force()};
      }

      ContinuumEnergy energy() const override
      {
        ContinuumEnergy energy;
        energy.external = solver.energy().external;
        energy.internal = solver.energy().internal;
        energy.damped   = solver.energy().damped;

        energy.dissipated             = solver.energy().dissipated.total();
        energy.materials_keep_account = true;
        return energy;
      }

      double coordinate() const override
      {
        switch (control.follow)
          {
          case ControlSection::Follow::indirect:
            return solver.measure(path);
          case ControlSection::Follow::arc_length:
            return travelled;
          default:
            return solver.time();
          }
      }

      double end() const override { return control.end; }

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        const bool                             follows_time = control.follow == ControlSection::Follow::time;
        std::vector<postprocess::SeriesColumn> all = {{follows_time ? "time" : "load_factor", follows_time ? "s" : "-"},
                                                      {"iterations", ""}};
        if (control.follow == ControlSection::Follow::indirect)
          all.push_back({"opening", "m"});
        if (control.follow == ControlSection::Follow::arc_length)
          all.push_back({"arc_length", "m"});
        if (control.relax)
          all.push_back({"energy_damped", "J"});
        if (!solid.linear())
          {
            all.push_back({"energy_plasticity", "J"});
            all.push_back({"energy_damage", "J"});
          }
        return all;
      }

      std::vector<double> values() const override
      {
        std::vector<double> row = {solver.time(), static_cast<double>(report_of_last.iterations)};
        if (control.follow != ControlSection::Follow::time)
          row.push_back(coordinate());
        if (control.relax)
          row.push_back(solver.energy().damped);
        if (!solid.linear())
          {
            row.push_back(solver.energy().dissipated.plasticity);
            row.push_back(solver.energy().dissipated.damage);
          }
        return row;
      }

      std::string details() const override
      {
        return fmt::format("step {}, {:.3e} of {:.3e}, {} iterations", accepted, coordinate(), end(),
                           report_of_last.iterations);
      }

      std::map<std::string, double> cost() const override
      {
        return {{"steps", static_cast<double>(accepted)},
                {"newton_iterations", static_cast<double>(iterations)},
                {"steps_stopped_at_rounding", static_cast<double>(rounded)},
                {"steps_relaxed", static_cast<double>(relaxed)},
                {"linear_iterations_of_last_solve", static_cast<double>(solver.linear_iterations())},
                {"stepping_seconds", seconds}};
      }

      std::string linear_solver() const override { return solver.linear_solver(); }

      fem::StaticSolver<dim> *static_solver() override { return &solver; }
      void tell_iterations_to(std::function<void(const std::string &)> told) override { listener = std::move(told); }

      void visit_state(base::StateVisitor &visitor) override
      {
        fem::StaticState saved = solver.state();
        visitor.scalar("time", saved.time);
        visitor.scalar("last_length", saved.last_length);
        visitor.scalar("external_work", saved.energy.external);
        visitor.scalar("internal_work", saved.energy.internal);
        visitor.scalar("damped_work", saved.energy.damped);
        visitor.scalar("dissipated_by_plasticity", saved.energy.dissipated.plasticity);
        visitor.scalar("dissipated_by_damage", saved.energy.dissipated.damage);
        visit_vector(visitor, "displacement", saved.displacement);
        visit_vector(visitor, "last_step", saved.last_step);
        visit_vector(visitor, "internal_force", saved.internal_force);
        solver.restore(saved);
        visitor.scalar("next_length", length);
        visitor.scalar("travelled", travelled);
        visitor.scalar("steps", accepted);
        visitor.scalar("iterations", iterations);
        visitor.scalar("rounded", rounded);
        visitor.scalar("relaxed", relaxed);
        visitor.scalar("stepping_seconds", seconds);
        visit_histories(visitor, solid);
      }

    private:
      /** Reports progress while a step is sought. */
      struct Speaking
      {
        explicit Speaking(Progress *&speaker)
          : shown(speaker)
        {
          shown = &progress;
        }
        ~Speaking() { shown = nullptr; }
        Speaking(const Speaking &)            = delete;
        Speaking &operator=(const Speaking &) = delete;

        Progress   progress{"equilibrium"};
        Progress *&shown;
      };

      /** A step, or what is sought without one, may take long: how far its iteration is. */
      void show_iteration(const unsigned int iteration, const double over_tolerance)
      {
        const std::string so_far =
          fmt::format("iteration {}: unbalanced force {:.2g} times the tolerance", iteration, over_tolerance);
        if (working)
          working->update(
            fmt::format("step {} towards {:.3e} of {:.3e}, {}", accepted + 1, coordinate() + length, end(), so_far));
        else if (listener)
          listener(so_far);
      }

      fem::Solid<dim>                         &solid;
      const ControlSection                    &control;
      fem::StaticSolver<dim>                   solver;
      fem::PathControl                         path;
      const double                             first;  ///< step
      double                                   length; ///< of the next step
      double                                   travelled = 0, seconds = 0;
      std::int64_t                             accepted = 0, iterations = 0, rounded = 0, relaxed = 0;
      fem::StepReport                          report_of_last;
      Progress                                *working = nullptr; ///< on a step
      std::function<void(const std::string &)> listener;          ///< beside steps
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_static_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    return std::make_unique<StaticAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_static_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_static_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps
