#pragma once

#include "postprocess/files/series.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Names of what a run can find, before it has run: a study or calibration that wants something else is refused before its first run. A run
   * need not find all of it.
   */
  struct RunOutcome
  {
    std::vector<std::string> figures; ///< by their path in summary.json, "laboratory/compressive_strength"
    std::vector<std::string> columns; ///< of series.csv, in their order

    /** @throws base::InputError that lists the names there are */
    void demand_figure(const std::string &path) const;
    void demand_column(const std::string &name) const;

    void set_columns(const std::vector<postprocess::SeriesColumn> &series);
    bool has_column(const std::string &name) const;

    void add_figures(const std::vector<std::string> &names);
    /** Those of figure_of() a column: how it ends, its least and its largest value. */
    void add_figures_of_column(const std::string &name);
  };

  /** Of a figure that is not among those known: with the nearest name and all of them. */
  std::string no_such_figure(const std::string &path, const std::vector<std::string> &known);
} // namespace apps
