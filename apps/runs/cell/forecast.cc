#include "apps/runs/cell/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/rank_shares.h"

#include <fmt/format.h>

namespace apps
{
  std::string forecast(const CellModel &model, const std::size_t ranks)
  {
    const base::Stopwatch set_up;
    const dem::Packing    packing = model.mixed().packing();
    dem::Specimen         body(packing, model.specimen(), model.mixed().materials(packing.material_names));
    dem::CellTest         test(body, model.loading()); // refuses what a run would refuse
    const double          set_up_seconds = set_up.seconds();
    double                duration       = 0;
    for (const dem::CellLeg &leg : model.loading().path)
      duration += leg.duration;
    std::string text;
    text += fmt::format("  particles    {}\n", body.counts().particles);
    text += fmt::format("  links        {}\n", body.counts().links);
    text += extent_lines(packing, model.physics.dimension);
    text += lines_of_tension_beyond_apex(model.material);
    text += MaterialCounts(packing.material_names, body).text();
    if (!test.holds_together())
      text += "  joined       not against every strain: stresses are reached only once particles touch\n";
    text += fmt::format("  time step    {:.4g} s\n", body.time_step());
    const double steps = duration / body.time_step();
    text += fmt::format("  steps        {:.0f}\n", steps);
    const double cost = seconds_per_step(body, [&](const std::int64_t count) { test.advance(count); });
    if (ranks > 0)
      text += rank_lines(body, ranks, cost);
    return text + duration_line(set_up_seconds + steps * cost);
  }

} // namespace apps
