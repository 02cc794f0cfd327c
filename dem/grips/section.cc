#include "dem/grips/section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    /** Extent of the particles along a direction, with their radii [m]. */
    struct Extent
    {
      double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

      Extent(const SpecimenShape &specimen, const int direction)
      {
        for (std::size_t i = 0; i < specimen.centre.size(); ++i)
          {
            low  = std::min(low, specimen.centre[i][direction] - specimen.radius[i]);
            high = std::max(high, specimen.centre[i][direction] + specimen.radius[i]);
          }
      }
      double length() const { return high - low; }
      double middle() const { return 0.5 * (low + high); }
    };
  } // namespace

  double nominal_section(const SpecimenShape &specimen, const int axis)
  {
    if (specimen.dimension == 2)
      return Extent(specimen, 1 - axis).length() * specimen.thickness;
    const int    first = (axis + 1) % 3, second = (axis + 2) % 3;
    const Extent across(specimen, first), other(specimen, second);
    double       reach = 0;
    for (std::size_t i = 0; i < specimen.centre.size(); ++i)
      reach = std::max(
        reach, std::hypot(specimen.centre[i][first] - across.middle(), specimen.centre[i][second] - other.middle()) +
                 specimen.radius[i]);
    return std::min(across.length() * other.length(), M_PI * reach * reach);
  }
} // namespace dem
