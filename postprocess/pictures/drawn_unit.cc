#include "postprocess/pictures/drawn_unit.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace postprocess
{
  DrawnUnit drawn_unit(const double peak, const std::string &unit)
  {
    static constexpr const char *prefixes[] = {"n", "µ", "m", "", "k", "M", "G"};
    if (unit.empty() || unit == "-")
      return {1, ""};
    // A square millimetre is a millionth of a square metre: the prefix belongs to what is raised.
    const int    power     = unit == "m^2" ? 2 : unit == "m^3" ? 3 : 1;
    const double lowest    = -1.5 * (power - 1); // decade of what is drawn in a unit
    int          thousands = 0;
    if (std::isfinite(peak) && peak != 0)
      thousands =
        std::clamp(static_cast<int>(std::floor((std::log10(std::fabs(peak)) - lowest) / (3 * power) + 1e-9)), -3, 3);
    return {std::pow(1000.0, -power * thousands), std::string(" [") + prefixes[thousands + 3] + unit + "]"};
  }

  std::string readable(std::string column)
  {
    std::replace(column.begin(), column.end(), '_', ' ');
    if (!column.empty())
      column.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(column.front())));
    return column;
  }
} // namespace postprocess
