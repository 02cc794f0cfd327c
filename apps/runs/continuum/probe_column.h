#pragma once

#include "postprocess/files/series.h"

#include <string>

namespace apps
{
  /** A column of the series, and what a summary reports of it. */
  struct ProbeColumn
  {
    enum class Reported
    {
      not_at_all,
      peak, ///< as peak_<name>: where it is largest in magnitude
      last  ///< at the end
    };
    postprocess::SeriesColumn column;
    Reported                  reported    = Reported::not_at_all;
    std::string               reported_as = ""; ///< of the last value: its name in the summary
  };

  /** A name as part of a column: without blanks, slashes and commas. */
  inline std::string column_name(std::string name)
  {
    for (char &c : name)
      if (c == ' ' || c == '/' || c == ',')
        c = '_';
    return name;
  }

  /** The column of a solid that is one of two bodies: its energies say whose they are. */
  inline postprocess::SeriesColumn of_solid(const ProbeColumn &probe)
  {
    postprocess::SeriesColumn column = probe.column;
    if (const std::string energy = "energy_"; column.name.rfind(energy, 0) == 0)
      column.name.insert(energy.size(), "solid_");
    return column;
  }
} // namespace apps
