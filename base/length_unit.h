#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

namespace base
{
  /** A unit in which files give lengths. */
  struct LengthUnit
  {
    const char *symbol     = "m";
    double      in_a_metre = 1; ///< a division by it rounds once, so that 3 mm are the same number as 0.003 m

    double metres(const double length) const { return length / in_a_metre; }
    bool   operator==(const LengthUnit &other) const { return in_a_metre == other.in_a_metre; }
    bool   operator!=(const LengthUnit &other) const { return !(*this == other); }
  };

  inline constexpr std::array<LengthUnit, 4> length_units = {{{"m", 1}, {"cm", 1e2}, {"mm", 1e3}, {"um", 1e6}}};

  /** Their symbols, for messages. */
  inline std::string length_unit_names()
  {
    std::string names;
    for (const LengthUnit &unit : length_units)
      names += (names.empty() ? "" : ", ") + std::string(unit.symbol);
    return names;
  }

  /** A unit by its symbol or its name, of either spelling, small or capital letters; empty for anything else. */
  inline std::optional<LengthUnit> length_unit(const std::string_view text)
  {
    struct Name
    {
      std::string_view word;
      std::size_t      unit; ///< its place among length_units
    };
    // The sign for micro is one of two characters, of two bytes each.
    static constexpr std::array<Name, 15> names = {{{"m", 0},
                                                    {"metre", 0},
                                                    {"meter", 0},
                                                    {"cm", 1},
                                                    {"centimetre", 1},
                                                    {"centimeter", 1},
                                                    {"mm", 2},
                                                    {"millimetre", 2},
                                                    {"millimeter", 2},
                                                    {"um", 3},
                                                    {"\xC2\xB5m", 3},
                                                    {"\xCE\xBCm", 3},
                                                    {"micrometre", 3},
                                                    {"micrometer", 3},
                                                    {"micron", 3}}};
    std::string                           sought(text);
    std::transform(sought.begin(), sought.end(), sought.begin(), [](const unsigned char c) { return std::tolower(c); });
    const bool word = sought.size() > 3; // symbols have no plural
    if (word && sought.back() == 's')
      sought.pop_back();
    for (const Name &name : names)
      if (sought == name.word)
        return length_units[name.unit];
    return std::nullopt;
  }
} // namespace base
