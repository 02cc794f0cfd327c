#pragma once

#include "postprocess/files/csv_table.h"
#include "postprocess/pictures/plot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Row of the largest magnitude. */
  std::size_t peak_row(const std::vector<double> &values);

  /**
   * Two columns of a series over each other, each upwards (with the sign of its peak) and in a unit that keeps its numbers short.
   * @param title of the panel
   */
  postprocess::PlotPanel drawn_curve(const postprocess::CsvTable &series,
                                     const std::string           &horizontal,
                                     const std::string           &vertical,
                                     const std::string           &title);

  /** The same as curve.png in a folder, or a warning where that cannot be drawn. @param from_rest both are zero before the first row */
  void write_curve(const std::filesystem::path &folder,
                   const postprocess::CsvTable &series,
                   const std::string           &horizontal,
                   const std::string           &vertical,
                   const std::string           &title,
                   bool                         from_rest = false);

  /**
   * The column that an entry of section Output names.
   * @param otherwise where the entry is empty. @throws base::InputError where there is no such column
   */
  std::string chosen_column(const std::vector<std::string> &columns,
                            const char                     *entry,
                            const std::string              &requested,
                            const std::string              &otherwise);
} // namespace apps
