#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /** One set of points of a plot. */
  struct PlotSeries
  {
    enum class Style
    {
      line,
      points,
      line_and_points
    };
    std::string         name;    ///< in the legend; empty: not in the legend
    std::vector<double> x, y;    ///< points where x or y is not finite are left out and break the line
    std::vector<double> y_error; ///< half height of the error bars; empty: none
    Style               style     = Style::line_and_points;
    bool                mark_peak = false; ///< mark the point of largest y with its values
  };

  /** One pair of axes. */
  struct PlotPanel
  {
    std::string             title, x_label, y_label;      ///< labels with units, e.g. "Stress [MPa]"
    bool                    log_x = false, log_y = false; ///< points that are not positive are then left out
    std::vector<PlotSeries> series;
  };

  /**
   * Draw panels side by side into a PNG file, by gnuplot.
   *
   * Never throws: a picture must not cost a finished run.
   * @return empty when drawn, otherwise why not (gnuplot missing, nothing to draw, unwritable folder), for a warning.
   */
  [[nodiscard]] std::string plot(const std::filesystem::path &path, const std::vector<PlotPanel> &panels) noexcept;

  /** One loading: stress over strain, in the sign in which it should point upwards. */
  struct StressStrainCurve
  {
    std::string         name;           ///< e.g. "tension, seed 1"
    std::vector<double> strain, stress; ///< [-], [Pa]
  };

  /** Stress-strain panel [MPa over 1e-3] with the peak of each curve marked. */
  PlotPanel stress_strain_panel(const std::string &title, const std::vector<StressStrainCurve> &curves);
} // namespace postprocess
