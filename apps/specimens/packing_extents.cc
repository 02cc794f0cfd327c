#include "apps/specimens/packing_extents.h"

#include "apps/specimens/packing_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace apps
{
  std::string extent_line(const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, const int dimension)
  {
    std::string text = "  extents      ";
    for (int d = 0; d < dimension; ++d)
      text += fmt::format("{}{} {:.4g} to {:.4g} m", d == 0 ? "" : ", ", "xyz"[d], lower[d], upper[d]);
    return text + "\n";
  }

  std::string extent_lines(const dem::Packing &packing, const int dimension)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Eigen::Vector3d  lower = Eigen::Vector3d::Constant(infinity), upper = -lower;
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        const Eigen::Vector3d reach = Eigen::Vector3d::Constant(packing.radius[i]);
        lower                       = lower.cwiseMin(packing.centre[i] - reach);
        upper                       = upper.cwiseMax(packing.centre[i] + reach);
      }
    const auto [smallest, largest] = std::minmax_element(packing.radius.begin(), packing.radius.end());
    return extent_line(lower, upper, dimension) +
           (*smallest == *largest ? fmt::format("  radius       {:.4g} m\n", *smallest) :
                                    fmt::format("  radii        {:.4g} to {:.4g} m\n", *smallest, *largest)) +
           density_line(packing, dimension);
  }
} // namespace apps
