#include "apps/runs/structure/promotion_steps.h"

#include <cmath>

namespace apps
{
  std::optional<PromotionStep> largest_promotion_step(const postprocess::CsvTable              &series,
                                                      const std::vector<dem::QuasiStaticPoint> &points)
  {
    const auto                  &force = series.column("force_of_load_factor"), &factor = series.column("load_factor");
    std::optional<PromotionStep> largest;
    for (std::size_t row = 1; row < force.size(); ++row)
      {
        if (points.at(row + 1).control != dem::StepControl::changed || force[row - 1] == 0)
          continue;
        const double change = force[row] / force[row - 1] - 1;
        if (!largest || std::abs(change) > std::abs(largest->change))
          largest = {change, factor[row]};
      }
    return largest;
  }
} // namespace apps
