#include "apps/studies/study_report.h"

#include "apps/results/warning.h"
#include "apps/studies/repeatable_page.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/html_page.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    using Row = std::vector<std::string>;

    constexpr std::size_t most_rows = 500; // of the page; table.csv has all

    std::string with_unit(const StudyFile &study, const std::vector<RunRecord> &records, const std::size_t response)
    {
      for (const RunRecord &record : records)
        if (!record.failed() && record.responses[response] && !record.units[response].empty())
          return study.responses[response].name + " [" + record.units[response] + "]";
      return study.responses[response].name;
    }

    std::vector<Row> table_of_runs(const StudyFile &study, const StudyPlan &plan, const std::vector<RunRecord> &records)
    {
      std::vector<Row> rows = {{"run"}};
      rows[0].insert(rows[0].end(), plan.columns.begin(), plan.columns.end());
      for (std::size_t k = 0; k < study.responses.size(); ++k)
        rows[0].push_back(with_unit(study, records, k));
      for (std::size_t run = 0; run < std::min(records.size(), most_rows); ++run)
        {
          rows.push_back({std::to_string(run + 1)});
          for (const double value : plan.values.row(static_cast<Eigen::Index>(run)))
            rows.back().push_back(fmt::format("{:.6g}", value));
          for (std::size_t k = 0; k < study.responses.size(); ++k)
            rows.back().push_back(!records[run].failed() && records[run].responses[k] ?
                                    fmt::format("{:.6g}", *records[run].responses[k]) :
                                    "");
        }
      return rows;
    }

    /** A panel for each factor. */
    std::vector<postprocess::PlotPanel> panels_of(const StudyPlan              &plan,
                                                  const std::vector<RunRecord> &records,
                                                  const std::string            &label,
                                                  const std::size_t             response)
    {
      std::vector<postprocess::PlotPanel> panels;
      for (std::size_t factor = 0; factor < plan.columns.size(); ++factor)
        {
          postprocess::PlotPanel panel;
          panel.x_label = plan.columns[factor];
          panel.y_label = label;
          panel.series.resize(1);
          panel.series[0].style = postprocess::PlotSeries::Style::points;
          for (std::size_t run = 0; run < records.size(); ++run)
            if (!records[run].failed() && records[run].responses[response])
              {
                panel.series[0].x.push_back(
                  plan.values(static_cast<Eigen::Index>(run), static_cast<Eigen::Index>(factor)));
                panel.series[0].y.push_back(*records[run].responses[response]);
              }
          panels.push_back(std::move(panel));
        }
      return panels;
    }

    /** Whether all factors but one are as in the first run. */
    bool varies_alone(const StudyPlan &plan, const Eigen::Index run, const Eigen::Index factor)
    {
      for (Eigen::Index other = 0; other < plan.values.cols(); ++other)
        if (other != factor && plan.values(run, other) != plan.values(0, other))
          return false;
      return true;
    }

    double slope_of(const std::vector<double> &x, const std::vector<double> &y)
    {
      double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          mean_x += x[k] / static_cast<double>(x.size());
          mean_y += y[k] / static_cast<double>(x.size());
        }
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          xx += (x[k] - mean_x) * (x[k] - mean_x);
          xy += (x[k] - mean_x) * (y[k] - mean_y);
        }
      return xx > 0 ? xy / xx : std::numeric_limits<double>::quiet_NaN();
    }

    std::vector<Row>
    elasticity_table(const StudyFile &study, const StudyPlan &plan, const std::vector<RunRecord> &records)
    {
      const Eigen::MatrixXd values = elasticities(plan, records);
      std::vector<Row>      rows   = {{"factor"}};
      for (const StudyResponse &response : study.responses)
        rows[0].push_back(response.name);
      for (Eigen::Index factor = 0; factor < values.cols(); ++factor)
        {
          rows.push_back({study.factors[factor].name});
          for (Eigen::Index response = 0; response < values.rows(); ++response)
            rows.back().push_back(
              std::isnan(values(response, factor)) ? "" : fmt::format("{:.3f}", values(response, factor)));
        }
      return rows;
    }

    std::vector<std::string> failures(const std::vector<RunRecord> &records)
    {
      std::vector<std::string> lines;
      for (std::size_t run = 0; run < records.size(); ++run)
        if (records[run].failed())
          lines.push_back(fmt::format("run {} failed: {}", run + 1, records[run].message));
      return lines;
    }
  } // namespace

  Eigen::MatrixXd elasticities(const StudyPlan &plan, const std::vector<RunRecord> &records)
  {
    const auto      responses = static_cast<Eigen::Index>(records.front().responses.size());
    Eigen::MatrixXd values(responses, plan.values.cols());
    for (Eigen::Index response = 0; response < responses; ++response)
      for (Eigen::Index factor = 0; factor < plan.values.cols(); ++factor)
        {
          std::vector<double> x, y;
          for (Eigen::Index run = 0; run < plan.values.rows(); ++run)
            if (varies_alone(plan, run, factor) && !records[run].failed() && records[run].responses[response])
              {
                x.push_back(std::log(plan.values(run, factor)));
                y.push_back(std::log(std::fabs(*records[run].responses[response])));
              }
          values(response, factor) = slope_of(x, y);
        }
    return values;
  }

  void write_report(const StudyFile              &study,
                    const StudyPlan              &plan,
                    const std::vector<RunRecord> &records,
                    const std::filesystem::path  &folder)
  {
    postprocess::HtmlPage page("Study " + study.file);
    page.paragraph(fmt::format("{} runs of {} over {} factors.", records.size(), study.base_scene, plan.values.cols()));
    page.list(failures(records));
    add_to_repeat(page, *study.root);
    if (study.design == DesignKind::one_at_a_time)
      {
        page.heading("Elasticities");
        page.paragraph("By how many percent a response changes where a factor is raised by one, all else being as in "
                       "the first run.");
        page.table(elasticity_table(study, plan, records));
      }
    for (std::size_t k = 0; k < study.responses.size(); ++k)
      {
        const std::string name = study.responses[k].name + ".png";
        warn_of_missing(name,
                        postprocess::plot(folder / name, panels_of(plan, records, with_unit(study, records, k), k)));
        page.heading(study.responses[k].name);
        page.picture(folder / name, study.responses[k].name + " of every run over each factor");
      }
    page.heading("Runs");
    if (records.size() > most_rows)
      page.paragraph(fmt::format("The first {}; table.csv has all.", most_rows));
    page.table(table_of_runs(study, plan, records));
    postprocess::write_text(folder / "report.html", page.text());
  }
} // namespace apps
