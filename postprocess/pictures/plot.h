#pragma once

#include <filesystem>
#include <string>
#include <utility>
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
    std::vector<double> x, y;    ///< points where x or y is not finite are left out and interrupt the line
    std::vector<double> y_error; ///< half height of error bars; empty: none
    Style               style = Style::line_and_points;
    std::string         colour;            ///< "#rrggbb"; empty: by the number of the series
    bool                mark_peak = false; ///< mark the point of largest y and give its place in the legend
  };

  /** Colour of the series of that number, from 0, where none is given. */
  const char *series_colour(std::size_t number);

  /** One pair of axes. */
  struct PlotPanel
  {
    std::string             title, x_label, y_label;      ///< labels with units, e.g. "Stress [MPa]"
    bool                    log_x = false, log_y = false; ///< points that are not above zero are then left out
    std::vector<PlotSeries> series;
    bool                    equal_axes = false; ///< the same length for a unit of x and of y
  };

  /** Least and largest abscissa of the points that are drawn; none: the first is larger. */
  std::pair<double, double> drawn_range(const PlotPanel &panel);

  /**
   * Draw panels, up to three in a row, into a PNG file, by gnuplot.
   *
   * Colours can be distinguished by colour-blind readers (Okabe and Ito, 2008). Panels without a single point are left
   * out. A picture must not cost a finished run: nothing is thrown, and the run goes on.
   *
   * @return empty when drawn, otherwise why not, for a warning: gnuplot missing, nothing to draw, unwritable file, ...
   */
  [[nodiscard]] std::string plot(const std::filesystem::path &path, const std::vector<PlotPanel> &panels) noexcept;

  /** Stress over strain of one loading, in the sign in which it should point upwards. */
  struct StressStrainCurve
  {
    std::string         name;             ///< e.g. "seed 1"
    std::vector<double> strain, stress;   ///< [-], [Pa]
    bool                mark_peak = true; ///< and its place in the legend
  };

  /** A panel of stress [MPa] over strain [1e-3] with the peak of each curve marked that requests it. */
  PlotPanel stress_strain_panel(const std::string &title, const std::vector<StressStrainCurve> &curves);
} // namespace postprocess
