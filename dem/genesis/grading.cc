#include "dem/genesis/grading.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  double plane_section_grading(const double content, const double size, const double largest)
  {
    const double x = size / largest;
    return content * (1.065 * std::sqrt(x) - 0.053 * std::pow(x, 4) - 0.012 * std::pow(x, 6) - 0.0045 * std::pow(x, 8) +
                      0.0025 * std::pow(x, 10));
  }

  double AggregateClass::middle_area() const { return M_PI / 4 * middle() * middle(); }

  std::vector<AggregateClass>
  aggregate_counts(const double content, const std::vector<double> &bounds, const double area)
  {
    if (!(content > 0 && content <= 1))
      throw base::InputError("Aggregates: content = " + base::number_text(content) + ": must be in (0, 1].");
    if (bounds.size() < 2)
      throw base::InputError("Aggregates: sizes: at least two, the bounds of one class.");
    std::vector<AggregateClass> classes;
    for (std::size_t i = 1; i < bounds.size(); ++i)
      {
        AggregateClass one;
        one.smallest = bounds[i - 1];
        one.largest  = bounds[i];
        if (!(one.smallest > 0 && one.largest > one.smallest && std::isfinite(one.largest)))
          throw base::InputError("Aggregates: sizes: " + base::number_text(one.smallest) + " m before " +
                                 base::number_text(one.largest) + " m: they must ascend from above 0.");
        const double part = plane_section_grading(content, one.largest, bounds.back()) -
                            plane_section_grading(content, one.smallest, bounds.back());
        one.exact = part * area / one.middle_area();
        one.count = static_cast<std::size_t>(std::round(one.exact));
        classes.push_back(one);
      }
    return classes;
  }

  double largest_aggregate_misfit(const double content, const std::vector<double> &bounds, const double area)
  {
    double misfit = 0;
    for (const AggregateClass &one : aggregate_counts(content, bounds, area))
      misfit = std::max(misfit, std::abs(static_cast<double>(one.count) - one.exact) * one.middle_area() / area);
    return misfit;
  }
} // namespace dem
