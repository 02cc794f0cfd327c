#include "apps/runs/coupled/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/forecasts/run_forecast.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/coupled/out_of_reach.h"
#include "apps/runs/coupled/run.h"
#include "apps/runs/coupled/sub_cycling_forecast.h"
#include "apps/runs/particles/damped_fall.h"
#include "apps/runs/particles/piled_up.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/specimen_snapshots.h"
#include "postprocess/vtk/pvd.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace apps
{
  namespace
  {
    double seconds_per_window(CoupledBody &body, const double end_time)
    {
      return seconds_per_unit([&](const std::int64_t count) {
        const std::int64_t before = body.windows();
        for (std::int64_t k = 0; k < count && body.time() < end_time; ++k) // what comes later is no part of the run
          body.advance(1);
        return body.windows() - before;
      });
    }

    /** Those taken and those to come, as long as they are now: contact shortens them. */
    double windows_of(const CoupledBody &body, const double end_time)
    {
      return static_cast<double>(body.windows()) + std::max(0.0, end_time - body.time()) / body.steps().window;
    }

    std::optional<dem::LinkMaterials> surface_contact(const CoupledModel &model)
    {
      if (model.couplings.couplings.empty())
        return std::nullopt;
      return model.couplings.couplings.front().contact.materials();
    }

    /** Rows of the series, and snapshots. */
    double writing_seconds(CoupledBody &body, const OutputSection &output)
    {
      const double rows = static_cast<double>(output.samples) * seconds_of([&] { body.row(); });
      if (output.snapshots == 0)
        return rows;
      return rows + static_cast<double>(std::min(output.snapshots, output.samples)) *
                      seconds_to_write([&](const std::filesystem::path &folder) {
                        SpecimenSnapshots taken;
                        taken.open(folder, "particles", output.pieces, {true, false});
                        taken.take(body.particles().specimen());
                        const postprocess::PvdCollection solids(folder, "solid", ".vtu");
                        body.write_solid(folder, solids.size());
                      });
    }
  } // namespace

  std::string forecast(const CoupledModel &model)
  {
    start_mpi();
    const base::Stopwatch       set_up;
    std::optional<dem::Packing> cell;
    const dem::Packing          packing = model.packing(&cell);
    const auto         body  = make_coupled_body(model, packing, model.media(cell)); // refuses what a run would refuse
    const StaticStart  start = body->start();
    const double       set_up_seconds = set_up.seconds();
    const auto        &specimen       = body->particles().specimen();
    const CoupledSteps steps          = body->steps();
    std::string        text;
    text += fmt::format("  elements     {}\n  unknowns     {}\n", body->elements(), body->unknowns());
    text += fmt::format("  particles    {}\n  links        {}\n", specimen.counts().particles, specimen.counts().links);
    text += extent_lines(packing, specimen.parameters().physics.dimension);
    text += lines_of_tension_beyond_apex(model.particles.material);
    text += MaterialCounts(packing.material_names, specimen).text();
    text += fmt::format("  groups       {}\n", text_of(model.particles.groups_in(packing)));
    if (!model.particles.walls.walls.empty())
      text += fmt::format("  walls        {}\n", body->particles().all_walls().text());
    for (const CouplingSection &coupling : model.couplings.couplings)
      text += fmt::format(
        "  coupling     {}: {} on {}\n", coupling.name,
        coupling.groups.empty() ? "all particles" : fmt::format("{}", fmt::join(coupling.groups, ", ")),
        coupling.boundaries.empty() ? "all of the boundary" : fmt::format("{}", fmt::join(coupling.boundaries, ", ")));
    text += couplings_out_of_reach(model, specimen, body->particles().all_groups());
    text += body->text_of_handshakes();
    text += fmt::format("  steps        solid {:.4g} s, particles {:.4g} s: ratio {:.3g}\n", steps.solid,
                        steps.particles, steps.solid / steps.particles);
    text += fmt::format("  window       {:.4g} s: {} of the solid, {} of the particles\n", steps.window,
                        steps.solid_steps == 1 ? "one step" : fmt::format("{} steps", steps.solid_steps),
                        steps.particle_steps);
    text += sub_cycling_forecast(model, *body);
    text += damped_fall_line(model.particles);
    if (start)
      text += fmt::format("  start        {}\n", text_of(*start));
    const char *fewer = model.particles.stops.stops.empty() ? "" : ", fewer where a stop condition comes first";
    try
      {
        const double cost =
          seconds_per_window(*body, model.particles.end_time) +
          body->steps().particle_steps * dearer_step_when_piled_up(model.particles, specimen, surface_contact(model));
        const double windows = windows_of(*body, model.particles.end_time);
        const double motion  = windows * cost + writing_seconds(*body, model.particles.output);
        text += fmt::format("  windows      {:.0f}{}\n", windows, fewer);
        text += model.particles.stops.duration_line(set_up_seconds, motion, model.particles.end_time);
      }
    catch (const std::runtime_error &failure)
      {
        text += fmt::format("  windows      {:.0f}{}\n  warning      the first steps fail: {}\n",
                            windows_of(*body, model.particles.end_time), fewer, failure.what());
      }
    return text;
  }

} // namespace apps
