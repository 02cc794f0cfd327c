#pragma once

#include <deal.II/base/types.h>

#include <array>
#include <map>
#include <string>

namespace fem
{
  /// A side of a shape along the axes, by word and by axis: words do not know which way is up.
  struct SideName
  {
    const char *word, *by_axis;
  };

  /// Two for each axis, that of least coordinates first.
  inline constexpr std::array<SideName, 6> side_names = {{{"left", "x min"},
                                                          {"right", "x max"},
                                                          {"bottom", "y min"},
                                                          {"top", "y max"},
                                                          {"back", "z min"},
                                                          {"front", "z max"}}};

  /// Adds the names by axis to boundaries that are called by a word, alone or behind the name of a body: "NAME z max" for "NAME front".
  void name_by_axis(std::map<std::string, dealii::types::boundary_id> &boundaries);
}
