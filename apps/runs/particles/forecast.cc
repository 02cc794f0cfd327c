#include "apps/runs/particles/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/forecasts/run_forecast.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/runs/particles/damped_fall.h"
#include "apps/runs/particles/piled_up.h"
#include "apps/runs/particles/run.h"
#include "apps/specimens/genesis_work.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/rank_shares.h"
#include "apps/specimens/specimen_snapshots.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace apps
{
  namespace
  {
    std::optional<dem::LinkMaterials> ground_of(const ParticlesModel &model)
    {
      if (model.walls.walls.empty())
        return std::nullopt;
      return model.walls.walls.front().contact.materials();
    }
  } // namespace

  namespace
  {
    /** Whole particles of classes of sizes leave another porosity than the prescribed one. */
    std::string porosity_line(const GenesisSection &genesis, const int dimension)
    {
      double solid = 0; // over the prescribed
      for (const ClassInVessel &one : genesis.classes_in_vessel(dimension))
        solid += one.part;
      const double porosity = genesis.full_porosity();
      return solid > 0 ? fmt::format("  porosity     {:.4f} with so many whole particles, for {:.4g}\n",
                                     1 - solid * (1 - porosity), porosity) :
                         "";
    }

    /** Of particles that are still to grow: how many, and how long that may take. */
    std::string growth_forecast(const ParticlesModel &model)
    {
      constexpr double usual_steps = 1.1e5, particle_steps_a_second = 1.5e7; // of one core, with 6000 and 55000 discs
      GenesisWork      work(model.source, model.physics.dimension);          // refuses what a run would refuse
      const auto       n    = static_cast<double>(work.particles());
      std::string      text = fmt::format("  particles    {}, to be grown:", work.particles());
      for (const std::size_t count : model.source.genesis.counts(model.physics.dimension))
        text += fmt::format(" {}", count);
      text += "\n";
      for (const ClassInVessel &one : model.source.genesis.classes_in_vessel(model.physics.dimension))
        text += fmt::format("  sizes        {} m: {}, {:.3g} of the solid for {:g}\n", text_of(one.size), one.count,
                            one.part, one.size.fraction);
      text += porosity_line(model.source.genesis, model.physics.dimension);
      const dem::Vessel vessel = model.source.genesis.vessel(model.physics.dimension);
      text += fmt::format("  vessel       {:g} x {:g}{} m\n", vessel.size[0], vessel.size[1],
                          vessel.dimension == 2 ? "" : fmt::format(" x {:g}", vessel.size[2]));
      text += work.is_kept() ? "  genesis      grown before, and kept: none\n" :
                               fmt::format("  genesis      roughly {} on one core\n",
                                           duration_text(usual_steps * n / particle_steps_a_second));
      return text + "  motion       known only when the particles have grown\n";
    }
  } // namespace

  std::string forecast(const ParticlesModel &model, const std::size_t ranks)
  {
    if (model.source.source == SpecimenSection::Source::genesis)
      {
        if (ranks > 0)
          throw base::InputError(
            "--ranks: the particles are still to grow; how they would be shared out is known of a packing "
            "that has grown.");
        return growth_forecast(model);
      }
    const base::Stopwatch set_up;
    const dem::Packing    packing = model.packing();
    ParticlesBody         body(model, packing); // refuses what a run would refuse
    const StaticStart     start          = body.start();
    const double          set_up_seconds = set_up.seconds();
    const auto           &specimen       = body.specimen();
    const double          longest        = model.end_time > 0 ? model.end_time : body.test()->longest_loading();
    const double          steps          = longest / specimen.time_step();
    std::string           text;
    text += fmt::format("  particles    {}\n", specimen.counts().particles);
    text += fmt::format("  links        {}\n", specimen.counts().links);
    text += extent_lines(packing, model.physics.dimension);
    text += lines_of_tension_beyond_apex(model.material);
    text += MaterialCounts(packing.material_names, specimen).text();
    text += model.jointed(packing).text();
    text += fmt::format("  groups       {}\n", text_of(model.groups_in(packing)));
    if (!model.walls.walls.empty())
      text += fmt::format("  walls        {}\n", body.all_walls().text());
    text += fmt::format("  time step    {:.4g} s = {} of the bound of its particles\n", specimen.time_step(),
                        model.time.step_factor);
    text +=
      fmt::format("  memory       {:.1f} MB for particles and links\n", 1e-6 * static_cast<double>(specimen.bytes()));
    text += damped_fall_line(model);
    if (model.precice.given())
      text += model.precice.forecast(body.all_groups().at(model.precice.vertices).size());
    if (start)
      text += fmt::format("  start        {}\n", text_of(*start));
    text += fmt::format("  steps        {:.0f}{}\n", steps,
                        body.test()               ? " at most in the loading, fewer where the test is over before" :
                        model.stops.stops.empty() ? "" :
                                                    ", fewer where a stop condition comes first");
    const auto   last = static_cast<std::int64_t>(std::ceil(steps)); // what moves further is no part of the run
    const double step =
      seconds_per_step(specimen,
                       [&](const std::int64_t count) { body.advance(std::min(count, last - specimen.steps())); }) +
      dearer_step_when_piled_up(model, specimen, ground_of(model));
    if (ranks > 0)
      text += rank_lines(specimen, ranks, step);
    const double row = seconds_of([&] { body.row(); });
    const double snapshot =
      model.output.snapshots == 0 ? 0.0 : seconds_to_write([&](const std::filesystem::path &folder) {
        SpecimenSnapshots snapshots;
        snapshots.open(folder, "particles", model.output.pieces,
                       {!model.walls.walls.empty() || model.laboratory.given(), model.bonded()});
        snapshots.take(specimen);
      });
    const double motion = steps * step + static_cast<double>(model.output.samples) * row +
                          static_cast<double>(std::min(model.output.snapshots, model.output.samples)) * snapshot;
    if (body.test())
      return text + stoppable_duration_line(set_up_seconds + motion, 0);
    return text + model.stops.duration_line(set_up_seconds, motion, longest);
  }

} // namespace apps
