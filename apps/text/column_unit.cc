#include "apps/text/column_unit.h"

#include "base/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace apps
{
  namespace
  {
    /** By what values of a unit are divided to be in another, of which it is a multiple: "kN" of "N". Empty: it is none. */
    std::optional<double> divisor(const std::string &from, const std::string &to)
    {
      if (from.empty() || from == to)
        return 1.0;
      struct Known
      {
        const char *from, *to;
        double      by;
      };
      static constexpr Known by_name[] = {{"%", "-", 1e2},
                                          {"per cent", "-", 1e2},
                                          {"percent", "-", 1e2},
                                          {"per mille", "-", 1e3},
                                          {"\u2030", "-", 1e3},
                                          {"1", "-", 1.0},
                                          {"N/mm^2", "Pa", 1e-6},
                                          {"N/mm2", "Pa", 1e-6},
                                          {"kN/mm^2", "Pa", 1e-9},
                                          {"N/m^2", "Pa", 1.0},
                                          {"kN/m^2", "Pa", 1e-3},
                                          {"MN/m^2", "Pa", 1e-6},
                                          {"N/m", "J/m^2", 1.0},
                                          {"N/mm", "J/m^2", 1e-3},
                                          {"N/mm", "N/m", 1e-3},
                                          {"kN/mm", "N/m", 1e-6},
                                          {"\u00b5m", "m", 1e6},
                                          {"\u03bcm", "m", 1e6},
                                          {"microns", "m", 1e6},
                                          {"sec", "s", 1.0},
                                          {"min", "s", 1.0 / 60},
                                          {"g", "kg", 1e3},
                                          {"t", "kg", 1e-3},
                                          {"deg", "rad", 180 / M_PI},
                                          {"degrees", "rad", 180 / M_PI}};
      for (const Known &known : by_name)
        if (from == known.from && to == known.to)
          return known.by;
      static constexpr std::pair<char, double> prefixes[] = {{'n', 1e9},  {'u', 1e6},  {'m', 1e3}, {'c', 1e2},
                                                             {'k', 1e-3}, {'M', 1e-6}, {'G', 1e-9}};
      const int power = to == "m^2" ? 2 : to == "m^3" ? 3 : 1; // of square millimetres a million are a square metre
      for (const auto &[letter, by] : prefixes)
        if (from[0] == letter && from.substr(1) == to)
          return std::pow(by, power);
      return std::nullopt;
    }

    std::vector<double> divided(std::vector<double> values, const double by)
    {
      for (double &value : values)
        value = by < 1 ? value * std::round(1 / by) : value / by; // one rounding
      return values;
    }
  } // namespace

  std::vector<double> column_in(const postprocess::CsvTable &table, const std::size_t place, const std::string &unit)
  {
    const std::optional<double> by = divisor(table.units[place], unit);
    if (!by)
      throw base::InputError(fmt::format("{}: column {} is in [{}], expected [{}], with a prefix if you like.",
                                         table.origin, table.names[place], table.units[place], unit));
    return divided(table.columns[place], *by);
  }

  void put_in_si(postprocess::CsvTable &table, const std::size_t place)
  {
    static const std::vector<std::string> units = {"-",     "m",  "m^2",   "m^3", "s",    "kg",    "N",
                                                   "Pa",    "J",  "m/s",   "1/s", "Pa/s", "N/m",   "N m",
                                                   "J/m^2", "Hz", "m/s^2", "rad", "N/s",  "kg/m^3"};
    std::string                          &given = table.units[place];
    if (given.empty() || std::find(units.begin(), units.end(), given) != units.end())
      return;
    for (const std::string &unit : units)
      if (const std::optional<double> by = divisor(given, unit))
        {
          table.columns[place] = divided(std::move(table.columns[place]), *by);
          given                = unit;
          return;
        }
    throw base::InputError(fmt::format("{}: column {} is in [{}], which is not known. Units: {}, with a prefix (kN, "
                                       "MPa, mm), or %.",
                                       table.origin, table.names[place], given, fmt::join(units, ", ")));
  }
} // namespace apps
