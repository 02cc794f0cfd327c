#include "postprocess/pictures/plot.h"

#include "postprocess/files/numeric_text.h"
#include "postprocess/pictures/gnuplot.h"
#include "postprocess/pictures/peak_words.h"
#include "postprocess/pictures/picture_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    // Okabe and Ito (2008), without the yellow that is too pale for lines; black last.
    constexpr std::array<const char *, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};
    constexpr std::array<int, 7>          markers = {7, 5, 9, 11, 13, 6, 4};

    constexpr int panel_width = 620, panel_height = 460, legend_row_height = 20, panels_in_row = 3;

    bool is_drawn(const PlotPanel &panel, const PlotSeries &series, const std::size_t i)
    {
      const double x = series.x[i], y = series.y[i];
      return std::isfinite(x) && std::isfinite(y) && (!panel.log_x || x > 0) && (!panel.log_y || y > 0);
    }

    std::size_t count_drawn(const PlotPanel &panel, const PlotSeries &series)
    {
      std::size_t count = 0;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        count += is_drawn(panel, series, i) ? 1 : 0;
      return count;
    }

    /** Panels and series that have something to show. */
    std::vector<PlotPanel> without_empty(const std::vector<PlotPanel> &panels)
    {
      std::vector<PlotPanel> kept;
      for (PlotPanel panel : panels)
        {
          for (const PlotSeries &series : panel.series)
            if (series.x.size() != series.y.size() ||
                (!series.y_error.empty() && series.y_error.size() != series.y.size()))
              throw std::invalid_argument("the columns of the series \"" + series.name + "\" differ in length");
          const auto is_empty = [&](const PlotSeries &series) { return count_drawn(panel, series) == 0; };
          panel.series.erase(std::remove_if(panel.series.begin(), panel.series.end(), is_empty), panel.series.end());
          if (!panel.series.empty())
            kept.push_back(panel);
        }
      return kept;
    }

    /** Of an error bar; none that a logarithmic axis could not show. */
    double lower_end(const PlotPanel &panel, const PlotSeries &series, const std::size_t i)
    {
      const double lower = series.y_error.empty() ? series.y[i] : series.y[i] - series.y_error[i];
      return panel.log_y && lower <= 0 ? series.y[i] : lower;
    }

    double upper_end(const PlotSeries &series, const std::size_t i)
    {
      return series.y_error.empty() ? series.y[i] : series.y[i] + series.y_error[i];
    }

    /** Rows of x, y, lower and upper end of the error bar; an empty row interrupts the line. */
    std::string data_of(const PlotPanel &panel, const PlotSeries &series)
    {
      std::string text;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        {
          if (is_drawn(panel, series, i))
            for (const double value : {series.x[i], series.y[i], lower_end(panel, series, i), upper_end(series, i)})
              {
                numeric_text::append(text, value);
                text += ' ';
              }
          text += '\n';
        }
      return text;
    }

    std::size_t peak_of(const PlotPanel &panel, const PlotSeries &series)
    {
      std::size_t peak = series.x.size();
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (is_drawn(panel, series, i) && (peak == series.x.size() || series.y[i] > series.y[peak]))
          peak = i;
      return peak;
    }

    std::string legend_of(const PlotPanel &panel, const PlotSeries &series)
    {
      if (series.name.empty())
        return " notitle";
      std::string text = series.name;
      if (series.mark_peak)
        text += " (" + peak_words(series.x, series.y, peak_of(panel, series)) + ")";
      return " title " + gnuplot_quoted(text) + " noenhanced";
    }

    /** The plot elements of one series: error bars, line or points, peak. */
    std::string
    elements_of(const PlotPanel &panel, const PlotSeries &series, const std::string &file, const std::size_t number)
    {
      const std::string colour =
        " lc rgb '" + (series.colour.empty() ? std::string(series_colour(number)) : series.colour) + "'";
      // When the colours begin again the markers are one further: no two of 49 series look alike.
      const std::size_t round  = number / markers.size();
      const std::string marker = " pt " + std::to_string(markers[(number + round) % markers.size()]) + " ps 0.9";
      const std::string source = gnuplot_quoted(file) + " using 1:";

      std::string text;
      if (!series.y_error.empty())
        text += source + "2:3:4 with yerrorbars pt 0 lw 1.5" + colour + " notitle, ";
      text += source + "2 with ";
      if (series.style == PlotSeries::Style::line)
        text += "lines lw 2" + colour;
      else if (series.style == PlotSeries::Style::points)
        text += "points" + marker + colour;
      else
        text += "linespoints lw 1.5" + marker + colour;
      text += legend_of(panel, series);
      if (series.mark_peak)
        text += ", " + gnuplot_quoted(file + "-peak") + " using 1:2 with points pt 6 ps 1.6 lw 2" + colour + " notitle";
      return text;
    }

    /** Ticks so far apart that their labels have room; nothing where gnuplot may choose. */
    std::string ticks_of(const PlotPanel &panel)
    {
      const auto [low, high] = drawn_range(panel);
      std::string text       = "set xtics autofreq\n";
      if (!panel.log_x && !panel.equal_axes && high > low)
        numeric_text::append(text = "set xtics ", horizontal_tick_step(low, high, panel_width - 120));
      return text + "\n";
    }

    /** From the lowest end of an error bar to the highest. */
    std::pair<double, double> drawn_heights(const PlotPanel &panel)
    {
      double low = 1e300, high = -1e300;
      for (const PlotSeries &series : panel.series)
        for (std::size_t i = 0; i < series.x.size(); ++i)
          if (is_drawn(panel, series, i))
            {
              low  = std::min(low, lower_end(panel, series, i));
              high = std::max(high, upper_end(series, i));
            }
      return {low, high};
    }

    /** Twos and fives beside the decades, as many as lie in the range; of a narrow one threes and sevens too. */
    std::string ticks_between_decades(const double low, const double high)
    {
      const bool  narrow = high < 8 * low;
      std::string text;
      for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10)
        for (const int digit : {2, 3, 5, 7})
          if (const double tick = digit * decade; tick >= low && tick <= high && (narrow || digit == 2 || digit == 5))
            numeric_text::append(text += text.empty() ? "" : ", ", tick);
      return text;
    }

    /**
     * A logarithmic axis ends where its points do, not at whole decades, which may be far from these.
     * @param axis its letter @param room beyond the ends, as a factor
     */
    std::string
    range_of(const char axis, const bool logarithmic, const std::pair<double, double> &drawn, const double room)
    {
      const auto [low, high] = drawn;
      if (!logarithmic || !(high > low))
        return std::string("set autoscale ") + axis + "\n";
      std::string text = std::string("set ") + axis + "range [";
      numeric_text::append(text, low / room);
      numeric_text::append(text += ':', high * room);
      text += "]\n";
      // Within one decade only its own number would be named.
      const std::string between = high < 30 * low ? ticks_between_decades(low / room, high * room) : "";
      return between.empty() ? text : text + "set " + axis + "tics add (" + between + ")\n";
    }

    std::string axes_of(const PlotPanel &panel)
    {
      std::string text = "set title " + gnuplot_quoted(panel.title) + " noenhanced font ',12'\n";
      text += "set xlabel " + gnuplot_quoted(panel.x_label) + " noenhanced offset 0,0.3\n";
      text += "set ylabel " + gnuplot_quoted(panel.y_label) + " noenhanced\n";
      text += ticks_of(panel);
      text += panel.equal_axes ? "set size ratio -1\n" : "set size noratio\n";
      text += panel.log_x ? "set logscale x\nset format x '%h'\n" : "unset logscale x\nset format x '%h'\n";
      text += range_of('x', panel.log_x, drawn_range(panel), 1.05);
      text += panel.log_y ? "set logscale y\nset format y '%h'\n" : "unset logscale y\nset format y '%h'\n";
      text += "set ytics autofreq\n";
      text += range_of('y', panel.log_y, drawn_heights(panel), 1.1);
      return text;
    }

    /** Add one panel to the script and its points to the data files. */
    void add_panel(GnuplotJob &job, const PlotPanel &panel, const std::size_t number)
    {
      std::string elements;
      for (std::size_t s = 0; s < panel.series.size(); ++s)
        {
          const PlotSeries &series = panel.series[s];
          const std::string file   = "panel" + std::to_string(number) + "-series" + std::to_string(s);
          elements += (s > 0 ? ", " : "") + elements_of(panel, series, file, s);
          job.data[file] = data_of(panel, series);
          if (const std::size_t peak = peak_of(panel, series); series.mark_peak)
            {
              std::string &point = job.data[file + "-peak"];
              numeric_text::append(point, series.x[peak]);
              numeric_text::append(point += ' ', series.y[peak]);
            }
        }
      job.script += axes_of(panel) + "plot " + elements + "\n";
    }

    GnuplotJob job_for(const std::vector<PlotPanel> &panels)
    {
      const int columns = std::min(static_cast<int>(panels.size()), panels_in_row);
      const int rows    = (static_cast<int>(panels.size()) + columns - 1) / columns;
      int       legend  = 0;
      for (const PlotPanel &panel : panels)
        legend = std::max(legend, static_cast<int>(panel.series.size()));

      GnuplotJob job;
      job.width  = columns * panel_width;
      job.height = rows * (panel_height + legend * legend_row_height);
      job.script = "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + "\n" +
                   "set border 3 lw 1.2 lc rgb '#404040'\nset tics nomirror out scale 0.6\n" +
                   "set grid xtics ytics lc rgb '#d8d8d8' lt 1 lw 1\nset key below left Left reverse maxcols 1 samplen "
                   "2 height 0.7\n" +
                   "set offsets graph 0, 0, graph 0.05, 0\n";
      for (std::size_t p = 0; p < panels.size(); ++p)
        add_panel(job, panels[p], p);
      job.script += "unset multiplot\n";
      return job;
    }
  } // namespace

  std::pair<double, double> drawn_range(const PlotPanel &panel)
  {
    double low = 1e300, high = -1e300;
    for (const PlotSeries &series : panel.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (is_drawn(panel, series, i))
          {
            low  = std::min(low, series.x[i]);
            high = std::max(high, series.x[i]);
          }
    return {low, high};
  }

  const char *series_colour(const std::size_t number) { return colours[number % colours.size()]; }

  std::string plot(const std::filesystem::path &path, const std::vector<PlotPanel> &panels) noexcept
  {
    try
      {
        const std::vector<PlotPanel> drawn = without_empty(panels);
        if (drawn.empty())
          return path.string() + ": not drawn: there is no point to draw.";
        draw_with_gnuplot(path, job_for(drawn));
        return {};
      }
    catch (const std::exception &error)
      {
        return path.string() + ": not drawn: " + error.what();
      }
  }

  PlotPanel stress_strain_panel(const std::string &title, const std::vector<StressStrainCurve> &curves)
  {
    PlotPanel panel;
    panel.title   = title;
    panel.x_label = "Strain [10⁻³]";
    panel.y_label = "Stress [MPa]";
    for (const StressStrainCurve &curve : curves)
      {
        PlotSeries series;
        series.name      = curve.name;
        series.style     = PlotSeries::Style::line;
        series.mark_peak = curve.mark_peak;
        for (const double strain : curve.strain)
          series.x.push_back(strain * 1e3);
        for (const double stress : curve.stress)
          series.y.push_back(stress * 1e-6);
        panel.series.push_back(std::move(series));
      }
    return panel;
  }
} // namespace postprocess
