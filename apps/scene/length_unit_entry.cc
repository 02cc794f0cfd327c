#include "apps/scene/length_unit_entry.h"

#include <string>
#include <vector>

namespace apps
{
  namespace
  {
    constexpr const char *unit_entry = "Length unit";

    std::vector<std::string> unit_symbols()
    {
      std::vector<std::string> symbols;
      for (const base::LengthUnit &unit : base::length_units)
        symbols.emplace_back(unit.symbol);
      return symbols;
    }
  } // namespace

  Entry &declare_packing_unit(Section &section, std::optional<base::LengthUnit> &unit)
  {
    std::vector<std::string> words = unit_symbols();
    words.insert(words.begin(), "of the file");
    const auto assign = [&unit](const std::size_t chosen) {
      unit.reset();
      if (chosen > 0)
        unit = base::length_units.at(chosen - 1);
    };
    return section.choice_of(unit_entry, words, 0, assign, Need::optional)
      .means("Of the lengths in the file. of the file: as it says itself, x [mm] or # lengths in mm, and otherwise m; "
             "a unit "
             "that contradicts the file is refused");
  }

  Entry &declare_mesh_unit(Section &section, std::optional<base::LengthUnit> &unit)
  {
    const auto assign = [&unit](const std::size_t chosen) { unit = base::length_units.at(chosen); };
    return section.choice_of(unit_entry, unit_symbols(), 0, assign, Need::optional)
      .means(
        "Of the coordinates in the file, which cannot say it. A mesh larger than 30 m is only taken where this is set");
  }
} // namespace apps
