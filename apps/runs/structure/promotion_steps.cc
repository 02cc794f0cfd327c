#include "apps/runs/structure/promotion_steps.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  std::optional<PromotionStep> largest_promotion_step(const postprocess::CsvTable              &series,
                                                      const std::vector<dem::QuasiStaticPoint> &points)
  {
    const auto                  &force = series.column("force_of_load_factor"), &factor = series.column("load_factor");
    std::optional<PromotionStep> largest;
    constexpr double             little = 1e-6; // of the largest force: where a weight alone acts there is none
    double                       most   = 0;
    for (const double of : force)
      most = std::max(most, std::fabs(of));
    for (std::size_t row = 1; row < force.size(); ++row)
      {
        if (points.at(row + 1).control != dem::StepControl::changed || std::fabs(force[row - 1]) <= little * most)
          continue;
        const double change = force[row] / force[row - 1] - 1;
        if (!largest || std::abs(change) > std::abs(largest->change))
          largest = {change, factor[row]};
      }
    return largest;
  }
} // namespace apps
