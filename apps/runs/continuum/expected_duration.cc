#include "apps/runs/continuum/expected_duration.h"

#include "apps/runs/continuum/one_step.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** Whether every step of a static analysis solves the same linear system. */
    bool is_linear(const ContinuumModel &model)
    {
      const auto &groups = model.materials.groups;
      return !model.solid.large_displacement &&
             std::none_of(groups.begin(), groups.end(), [](const auto &group) { return group->law->has_history(); });
    }

    /** Of a static run past the states that were tried. */
    template <typename Rehearsal>
    double
    static_seconds(const ContinuumModel &model, const Rehearsal &tried, const double iterations, const double states)
    {
      // notched_beam.prm, notched_beam_3d.prm and gmsh_panel.prm take 6.5, 7.1 and 9.4 iterations for each step of the longest
      // length, steps that are cut among them; one costs 1.3 times an elastic one, for the walks of points and the line searches.
      constexpr double iterations_when_cracking = 7, cracking_iteration = 1.3;
      const double     each = tried.states > 1 ? (tried.seconds - tried.first) / (tried.states - 1) : tried.first;
      if (iterations == 0 || is_linear(model))
        return tried.first + (states - 1) * each;
      const double iteration = tried.seconds / iterations;
      return tried.first + (states - 1) * std::max(each, iterations_when_cracking * cracking_iteration * iteration);
    }

    template <typename Rehearsal>
    double motion_seconds(const ContinuumModel                &model,
                          const Rehearsal                     &tried,
                          const std::map<std::string, double> &costs,
                          const double                         states)
    {
      // Contact shortens steps: those to come are as long as the last one.
      const double each      = tried.states > 1 ? (tried.seconds - tried.first) / (tried.states - 1) : tried.first;
      const double mean_step = model.motion.end_time * tried.states / states / std::max(1.0, costs.at("steps"));
      return tried.first + (states - 1) * each * std::max(1.0, mean_step / costs.at("time_step"));
    }
  } // namespace

  template <int dim>
  double states_of(const fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    return one_step_does(solid, model.control) ? 1 : std::ceil(model.control.end / model.control.largest());
  }

  template double states_of(const fem::Solid<2> &, const ContinuumModel &);
  template double states_of(const fem::Solid<3> &, const ContinuumModel &);

  template <int dim>
  ExpectedRun expected(ContinuumRun<dim> &run, const ContinuumModel &model, const double states)
  {
    // Contact of bodies shortens steps the more, the deeper it is: it is seen for a fifth of the motion. A run that may stop at any time is
    // tried for longer: if it is a short one, to its end.
    const bool   may_stop = model.is_static() && model.control.stop_fraction > 0;
    const double enough   = may_stop ? 4 : model.is_static() ? 1 : 2; // [s]
    const double at_most  = may_stop ? states : std::min(states, model.is_static() ? 10.0 : std::max(10.0, states / 5));
    const auto tried = run.rehearse(at_most, enough);
    ExpectedRun  found{tried.seconds, tried.states, tried.ended, tried.failure};
    if (tried.ended)
      return found;
    const auto costs      = run.computation().cost();
    const auto iterations = costs.find("newton_iterations");
    found.seconds         = model.is_static() ?
                              static_seconds(model, tried, iterations == costs.end() ? 0.0 : iterations->second, states) :
                              motion_seconds(model, tried, costs, states);
    return found;
  }

  template ExpectedRun expected<2>(ContinuumRun<2> &, const ContinuumModel &, double);
  template ExpectedRun expected<3>(ContinuumRun<3> &, const ContinuumModel &, double);
} // namespace apps
