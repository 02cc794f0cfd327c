#include "apps/runs/quasi_static/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/forecasts/path_forecast.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/runs/quasi_static/lab_test.h"
#include "apps/specimens/packing_extents.h"

#include <fmt/format.h>

namespace apps
{
  std::string forecast(const QuasiStaticModel &model)
  {
    const base::Stopwatch set_up;
    const dem::Packing    packing        = model.packing();
    const JointedPacking  jointed        = model.jointed(packing);
    const auto            loaded         = model.load(jointed);
    const double          set_up_seconds = set_up.seconds();
    std::string           text;
    text += fmt::format("  particles    {}\n", loaded.network.particles());
    text += fmt::format("  links        {}\n", loaded.network.links.size());
    text += extent_lines(packing, loaded.network.dimension);
    text += lines_of_tension_beyond_apex(model.material);
    text += materials_in(loaded.network, packing.material_names).text();
    text += jointed.text();
    if (!model.is_cell())
      text += fmt::format("  basis        {}\n", text_of(model.grip_layers(packing), model.grips.parameters()));
    double seconds = 0;
    for (const UniaxialLoad load : model.tests)
      {
        text += fmt::format("  {:<12} at least {:.0f} points to its stop strain\n", name_of(load),
                            model.steps(load).end_strain / model.steps(load).strain_step);
        seconds += set_up_seconds + expected_path_seconds(loaded, model.materials(jointed), model.steps(load));
      }
    return text + duration_line(seconds);
  }

} // namespace apps
