#include "apps/bench/results.h"

#include "apps/process/exit_status.h"
#include "apps/results/warning.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"

#include <fmt/format.h>

#include <utility>

namespace apps
{
  BenchResults::BenchResults(std::filesystem::path where, std::string what)
    : folder(std::move(where))
    , name(std::move(what))
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw postprocess::OutputError(folder.string() + ": the output folder cannot be made: " + error.message() + ".");
  }

  void BenchResults::write(const std::string &csv, const std::string &table) const
  {
    postprocess::write_text(file(".csv"), csv);
    postprocess::write_text(file(".md"), table);
  }

  void BenchResults::draw(const std::vector<postprocess::PlotPanel> &panels) const
  {
    warn_of_missing(name + ".png", postprocess::plot(file(".png"), panels));
  }

  int BenchResults::finish(const std::vector<postprocess::PlotPanel> &panels) const
  {
    draw(panels);
    fmt::print("written to {0}: {1}.csv, {1}.md, {1}.png\n", folder.string(), name);
    return exit_success;
  }

  postprocess::PlotPanel
  error_over_cost(const std::string &title, const std::string &cost_label, const std::vector<CostPoint> &points)
  {
    postprocess::PlotPanel panel;
    panel.title   = title;
    panel.x_label = cost_label;
    panel.y_label = "Error";
    panel.log_x = panel.log_y = true;
    for (std::size_t k = 1; k < points.size(); ++k)
      {
        if (k == 1 || points[k].study != points[k - 1].study)
          {
            panel.series.emplace_back();
            panel.series.back().name  = points[k].study;
            panel.series.back().style = postprocess::PlotSeries::Style::points;
          }
        panel.series.back().x.push_back(points[k].cost / points.front().cost);
        panel.series.back().y.push_back(points[k].error);
      }
    return panel;
  }
} // namespace apps
