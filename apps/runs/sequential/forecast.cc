#include "apps/runs/sequential/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/runs/continuum/expected_duration.h"
#include "apps/runs/continuum/run.h"
#include "apps/runs/sequential/groundwork.h"
#include "apps/runs/sequential/law_identification.h"
#include "apps/runs/sequential/particle_case.h"
#include "apps/specimens/packing_extents.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    double seconds_of_particles(const ParticleEventSection &event, const dem::Packing &packing)
    {
      double seconds = 0;
      for (std::size_t k = 0; k < event.cases(); ++k)
        seconds += expected_seconds(*make_particle_case(event, packing, k));
      if (const auto reference = make_reference_case(event, packing))
        seconds += expected_seconds(*reference);
      return seconds;
    }

    /** One continuation, which begins in the virgin solid here. */
    template <int dim>
    double seconds_of_continuation(const ContinuumModel &model)
    {
      ContinuumRun<dim> run(RunRequest{}, model);
      return expected(run, model, states_of(run.body(), model)).seconds;
    }
  } // namespace

  std::string forecast(const SequentialModel &model)
  {
    const base::Stopwatch      set_up;
    const SequentialGroundwork ground         = groundwork_of(model);
    const double               set_up_seconds = set_up.seconds();
    std::string text = fmt::format("  transfers    {}\n  elements     {}\n  unknowns     {}\n", model.particles.cases(),
                                   ground.elements, ground.unknowns);
    const auto  first = make_particle_case(model.particles, ground.packing, 0);
    if (const dem::Specimen *body = first->body())
      text += fmt::format("  particles    {}\n  links        {}\n  time step    {:.4g} s\n", body->counts().particles,
                          body->counts().links, body->time_step());
    if (ground.packing.size() > 0)
      text += extent_lines(ground.packing, model.particles.physics.dimension);
    if (const StaticStart start = first->settle())
      text += fmt::format("  start        {}\n", text_of(*start));
    for (const std::string &doubt : ground.doubts)
      text += fmt::format("  warning      {}\n", doubt);
    double seconds = set_up_seconds + seconds_of_particles(model.particles, ground.packing);
    if (model.transfer.identifies())
      seconds += LawIdentification(model, ground.origin, ground.element_size).expected_seconds(ground.packing);
    try
      {
        seconds += static_cast<double>(model.particles.cases()) * (model.continuum.solid.dimension == 2 ?
                                                                     seconds_of_continuation<2>(model.continuum) :
                                                                     seconds_of_continuation<3>(model.continuum));
      }
    catch (const std::runtime_error &failure)
      {
        return text + fmt::format("  warning      the first step of an undamaged solid fails: {}\n", failure.what());
      }
    return text + duration_line(seconds);
  }

} // namespace apps
