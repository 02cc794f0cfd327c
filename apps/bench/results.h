#pragma once

#include "postprocess/pictures/plot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Where a bench leaves what it measured: NAME.csv, NAME.md and NAME.png in a folder. */
  class BenchResults
  {
  public:
    /** Makes the folder. @throws postprocess::OutputError. */
    BenchResults(std::filesystem::path folder, std::string name);

    /** @throws postprocess::OutputError. */
    void write(const std::string &csv, const std::string &table) const;
    /** Draws the figure; a warning where that is not possible. */
    void draw(const std::vector<postprocess::PlotPanel> &panels) const;
    /** The same, and says where everything is. @return exit status */
    int finish(const std::vector<postprocess::PlotPanel> &panels) const;

  private:
    std::filesystem::path file(const char *extension) const { return folder / (name + extension); }

    std::filesystem::path folder;
    std::string           name;
  };

  /** What one variant of a study costs, and how far off it is. */
  struct CostPoint
  {
    std::string study;
    double      cost = 0, error = 0;
  };

  /** Error over the cost in that of the first, which is the reference and no point itself; a series for each study in a row. */
  postprocess::PlotPanel
  error_over_cost(const std::string &title, const std::string &cost_label, const std::vector<CostPoint> &points);
} // namespace apps
