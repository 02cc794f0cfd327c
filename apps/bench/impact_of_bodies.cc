#include "apps/bench/impact_of_bodies.h"

#include "apps/process/interrupt.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/solid.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <cmath>

namespace apps
{
  namespace
  {
    template <int dim>
    ImpactMeasurement impact_of_bodies(const ContinuumModel &model, const SceneVariant &which, Progress &progress)
    {
      const auto   solid    = make_solid<dim>(model);
      const auto   analysis = make_explicit_analysis<dim>(*solid, model);
      const double start    = base::processor_seconds();
      while (!analysis->finished() && !interrupted())
        {
          analysis->advance();
          progress.update(analysis->coordinate() / analysis->end(), analysis->details());
        }
      ImpactMeasurement found;
      found.which                  = which;
      found.cost                   = base::processor_seconds() - start;
      const ContinuumEnergy energy = analysis->energy();
      const ContactFigures &seen   = *analysis->contact_figures();
      const auto            names  = analysis->columns();
      const auto            values = analysis->values();
      found.elements               = solid->mesh().triangulation->n_active_cells();
      found.windows                = static_cast<std::int64_t>(analysis->cost().at("steps"));
      found.force_error            = seen.peak_force / model.references.peak_force - 1;
      found.time_error             = seen.contact_time() / model.references.contact_time - 1;
      found.missing =
        (energy.external + energy.start - energy.kinetic - energy.damped - energy.internal - energy.contacts) /
        energy.start;
      for (std::size_t c = 0; c < names.size(); ++c)
        if (names[c].name == model.contacts.contacts.front().name + "_spurious")
          found.made = values[c] / energy.start;
      return found;
    }
  } // namespace

  std::vector<SceneVariant> impacts_of_bodies(const ContinuumModel &model, const bool quick)
  {
    const ContactSection &contact = model.contacts.contacts.front();
    const double          own     = static_cast<double>(model.mesh.balls.front().divisions);
    const auto            with    = [&](const char *study, const std::string &value, const int divisions) {
      SceneVariant made{study, value, {}};
      for (const BallSection &ball : model.mesh.balls)
        made.changes.push_back(fmt::format("Mesh/Balls/{}/Divisions={}", ball.name, divisions));
      made.changes.push_back(fmt::format("Contacts/{}/Stiffness={:.4g}", contact.name,
                                                       contact.law.stiffness * std::pow(divisions / own, 4)));
      made.changes.push_back(fmt::format("Contacts/{}/Energy limit=1e9", contact.name)); // what is made is measured
      return made;
    };
    constexpr int             other = 4; // for all but the mesh
    std::vector<SceneVariant> all;
    for (const int n : quick ? std::vector<int>{other} : std::vector<int>{other, 6})
      all.push_back(with("balls", fmt::format("{} around a quarter", n), n));
    if (quick)
      return all;
    for (const char *safety : {"0.9", "0.45", "0.2"})
      {
        all.push_back(with("balls, step", safety, other));
        all.back().changes.push_back(std::string("Motion/Safety=") + safety);
      }
    for (const double times : {0.3, 3.0})
      {
        all.push_back(with("balls, stiffness", fmt::format("{:g} times", times), other));
        all.back().changes.push_back(fmt::format("Contacts/{}/Stiffness={:.4g}", contact.name,
                                                 times * contact.law.stiffness * std::pow(other / own, 4)));
      }
    return all;
  }

  ImpactMeasurement measure_bodies(const ContinuumModel &model, const SceneVariant &which, Progress &progress)
  {
    return model.solid.dimension == 2 ? impact_of_bodies<2>(model, which, progress) :
                                        impact_of_bodies<3>(model, which, progress);
  }
} // namespace apps
