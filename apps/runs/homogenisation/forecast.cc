#include "apps/runs/homogenisation/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/specimens/packing_extents.h"
#include "base/stopwatch.h"
#include "postprocess/packings/packing_io.h"

#include <fmt/format.h>

namespace apps
{
  std::string forecast(const HomogenisationModel &model)
  {
    const std::vector<double> interaction = model.interaction_ratios, shear = model.shear_ratios;
    const bool                made  = model.source == SpecimenSection::Source::generator;
    const auto                count = static_cast<double>(made ? model.seeds : 1);
    const base::Stopwatch     making;
    const dem::Packing first = made ? model.made_packing(1) : postprocess::read_packing(model.file, model.length_unit);
    const double       making_seconds = making.seconds();
    double             solving        = 0; // of all cases of the first packing, one solved for each interaction ratio
    for (const double ratio : interaction)
      {
        const base::Stopwatch watch;
        homogenise(first, model.question(ratio, shear.front()), made ? "generator" : model.file);
        solving += watch.seconds() * static_cast<double>(shear.size());
      }
    return fmt::format("  packings     {:.0f}, of {} particles\n", count, first.size()) +
           extent_lines(first, model.thickness > 0 ? 2 : 3) +
           fmt::format("  solutions    {:.0f}, of six load cases each\n",
                       count * static_cast<double>(interaction.size() * shear.size())) +
           duration_line(count * (making_seconds + solving));
  }

} // namespace apps
