#pragma once

#include "postprocess/files/csv_table.h"
#include "postprocess/pictures/plot.h"

#include <string>
#include <vector>

namespace apps
{
  /** Column over which others of a series are drawn: its time, or its first one of numbers; "" where it has no numbers. */
  std::string abscissa_of(const postprocess::CsvTable &series);

  /**
   * Columns of a series over another one, a curve for each word of its first column of words ("tension", "compression").
   * @param verticals their names, of one unit  @throws base::InputError that lists the columns there are
   */
  postprocess::PlotPanel panel_of_columns(const postprocess::CsvTable    &series,
                                          const std::string              &horizontal,
                                          const std::vector<std::string> &verticals);

  /** A panel for each column of a series that changes, energies apart, up to a number that a reader can take in. */
  std::vector<postprocess::PlotPanel> panels_of_columns(const postprocess::CsvTable &series);
  /** Its energies together, and apart what their balances are off by; nothing where it has none. */
  std::vector<postprocess::PlotPanel> panels_of_energies(const postprocess::CsvTable &series);
  /** Of a whole series: panels_of_columns(), and energies together as the last one. */
  std::vector<postprocess::PlotPanel> panels_of_series(const postprocess::CsvTable &series);
} // namespace apps
