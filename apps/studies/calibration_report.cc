#include "apps/results/warning.h"
#include "apps/studies/calibration.h"
#include "apps/studies/calibration_picture.h"
#include "apps/studies/repeatable_page.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/html_page.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    using postprocess::PlotSeries;
    using Row = std::vector<std::string>;

    std::string number(const double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

    PlotSeries line_of(const std::string &name, const std::vector<double> &x, const Eigen::VectorXd &y)
    {
      PlotSeries series;
      series.name  = name;
      series.style = PlotSeries::Style::line;
      series.x     = x;
      series.y     = {y.begin(), y.end()};
      return series;
    }

    /** Measured points, what the constants give for them and the bands around it. */
    postprocess::PlotPanel panel_of(const CalibrationFile &file,
                                    const CalibrationRuns &runs,
                                    const Calibration     &found,
                                    const std::size_t      target)
    {
      const Eigen::Index    begin = runs.first_of(target), count = runs.first_of(target + 1) - begin;
      const Eigen::VectorXd places    = runs.abscissae().segment(begin, count),
                            predicted = found.predicted.segment(begin, count),
                            half      = found.half_widths.segment(begin, count);
      const std::vector<double> x(places.begin(), places.end());
      postprocess::PlotPanel    panel;
      panel.title                = file.targets[target].name;
      panel.x_label              = runs.labels_of(target).first;
      panel.y_label              = runs.labels_of(target).second;
      panel.series               = {line_of("measured", x, runs.measured().segment(begin, count)),
                                    line_of("calibrated", x, predicted)};
      panel.series.front().style = PlotSeries::Style::points;
      if (half.allFinite())
        {
          panel.series.push_back(line_of("band of 95 %, linearised", x, predicted - half));
          panel.series.push_back(line_of("", x, predicted + half));
          panel.series[3].colour = panel.series[2].colour = "#56b4e9";
        }
      if (found.posterior)
        {
          const std::size_t first = panel.series.size();
          panel.series.push_back(line_of("band of 95 %, posterior", x, found.posterior->lowest.segment(begin, count)));
          panel.series.push_back(line_of("", x, found.posterior->highest.segment(begin, count)));
          panel.series[first + 1].colour = panel.series[first].colour = "#d55e00";
        }
      return panel;
    }

    std::vector<Row> constants_table(const CalibrationFile &file, const Calibration &found)
    {
      std::vector<Row> rows = {
        {"constant", "value", "standard error", "band of 95 %", "determined", "start", "bounds"}};
      if (found.posterior)
        rows[0].insert(rows[0].end(), {"posterior mean", "deviation", "band of 95 %"});
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        {
          const SoughtConstant &own = file.constants[k];
          rows.push_back({own.name, number(found.constants[k]), number(found.standard_errors[k]),
                          found.determined[k] ? number(found.lower[k]) + " to " + number(found.upper[k]) : "",
                          found.determined[k] ? "yes" : "no", number(own.start),
                          number(own.lower) + " to " + number(own.upper)});
          if (found.posterior)
            rows.back().insert(rows.back().end(),
                               {number(found.posterior->mean[k]), number(found.posterior->standard_deviation[k]),
                                number(found.posterior->lower[k]) + " to " + number(found.posterior->upper[k])});
        }
      return rows;
    }

    std::vector<Row> correlation_table(const CalibrationFile &file, const Calibration &found)
    {
      std::vector<Row> rows = {{""}};
      for (const SoughtConstant &constant : file.constants)
        rows[0].push_back(constant.name);
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        {
          rows.push_back({file.constants[k].name});
          for (std::size_t other = 0; other < file.constants.size(); ++other)
            rows.back().push_back(
              found.determined[k] && found.determined[other] ? fmt::format("{:.3f}", found.correlation(k, other)) : "");
        }
      return rows;
    }

    std::vector<Row> targets_table(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found)
    {
      std::vector<Row> rows = {{"target", "measured", "calibrated", "off by [%]"}};
      for (std::size_t k = 0; k < file.targets.size(); ++k)
        {
          const Eigen::Index    begin = runs.first_of(k), count = runs.first_of(k + 1) - begin;
          const Eigen::VectorXd measured  = runs.measured().segment(begin, count),
                                predicted = found.predicted.segment(begin, count);
          const std::string off = fmt::format("{:.3g}", 100 * (predicted - measured).norm() / measured.norm());
          if (file.targets[k].is_curve())
            rows.push_back({file.targets[k].name, fmt::format("curve of {} points", count), "", off});
          else
            rows.push_back({file.targets[k].name, number(measured[0]), number(predicted[0]), off});
        }
      return rows;
    }
  } // namespace

  void write_report(const CalibrationFile       &file,
                    const CalibrationRuns       &runs,
                    const Calibration           &found,
                    const std::filesystem::path &folder)
  {
    postprocess::HtmlPage page("Calibration " + file.file);
    page.paragraph(fmt::format("{} sets of constants, {} of them without an answer; it ended because: {}",
                               found.evaluations + found.cheap_evaluations, found.failed, found.ending));
    page.list(warnings_of(found));
    add_to_repeat(page, *file.root);
    page.heading("Constants");
    page.table(constants_table(file, found));
    page.heading("Targets");
    page.paragraph("A curve is off by the root mean square of its deviations over that of its ordinates.");
    page.table(targets_table(file, runs, found));
    if (std::any_of(file.targets.begin(), file.targets.end(), [](const auto &target) { return !target.is_curve(); }))
      {
        warn_of_missing("figures.png", draw_figures_and_constants(file, runs, found, folder / "figures.png"));
        page.picture(folder / "figures.png", "How far figures are off, and where constants lie between their bounds");
      }
    for (std::size_t k = 0; k < file.targets.size(); ++k)
      if (file.targets[k].is_curve())
        {
          const std::string name = file.targets[k].name + ".png";
          warn_of_missing(name, postprocess::plot(folder / name, {panel_of(file, runs, found, k)}));
          page.picture(folder / name, file.targets[k].name);
        }
    page.heading("Correlation");
    page.paragraph(fmt::format("Of the errors of constants; condition number {:.3g}.", found.condition));
    page.table(correlation_table(file, found));
    postprocess::write_text(folder / "report.html", page.text());
  }
} // namespace apps
