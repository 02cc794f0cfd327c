#include "apps/drivers/continuum/expected_duration.h"

#include "apps/drivers/continuum/analysis.h"
#include "apps/drivers/continuum/solid.h"
#include "apps/drivers/parts/duration.h"
#include "base/errors.h"

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

    template <int dim>
    double measured_seconds(const ContinuumModel &model, const double states)
    {
      // notched_beam.prm, notched_beam_3d.prm and gmsh_panel.prm take 6.5, 7.1 and 9.4 iterations for each step of the longest
      // length, steps that are cut among them; one costs 1.3 times an elastic one, for the walks of points and the line searches.
      constexpr double iterations_when_cracking = 7, cracking_iteration = 1.3;
      // Contact of bodies shortens steps the more, the deeper it is: it is seen for a fifth of the motion.
      const double enough           = model.is_static() ? 1 : 2; // [s]
      const double measured_at_most = model.is_static() ? 10 : std::max(10.0, states / 5);
      const auto   solid            = make_solid<dim>(model);
      const auto   analysis =
        model.is_static() ? make_static_analysis<dim>(*solid, model) : make_explicit_analysis<dim>(*solid, model);
      const Stopwatch all;
      double          first = 0, measured = 0;
      while (!analysis->finished() && measured < std::min(states, measured_at_most) &&
             (measured < 2 || all.seconds() < enough))
        {
          while (!analysis->advance())
            continue;
          first = measured == 0 ? all.seconds() : first;
          ++measured;
        }
      const double each  = measured > 1 ? (all.seconds() - first) / (measured - 1) : first;
      const auto   costs = analysis->cost();
      const auto   found = costs.find("newton_iterations");
      if (!model.is_static())
        {
          // Contact shortens steps: those to come are as long as the last one.
          const double mean_step = model.motion.end_time * measured / states / std::max(1.0, costs.at("steps"));
          return first + (states - 1) * each * std::max(1.0, mean_step / costs.at("time_step"));
        }
      if (found == costs.end() || is_linear(model))
        return first + (states - 1) * each;
      const double iteration = all.seconds() / std::max(1.0, found->second);
      return first + (states - 1) * std::max(each, iterations_when_cracking * cracking_iteration * iteration);
    }
  } // namespace

  double states_of(const ContinuumModel &model) { return std::ceil(model.control.end / model.control.largest()); }

  template <int dim>
  double expected_seconds(const ContinuumModel &model, const double states)
  {
    return measured_seconds<dim>(model, states);
  }

  template double expected_seconds<2>(const ContinuumModel &, double);
  template double expected_seconds<3>(const ContinuumModel &, double);
} // namespace apps
