#include "apps/bench/uniaxial_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    using Measured = Scatter UniaxialMeasurement::*;

    struct NamedFigure
    {
      const char *name, *unit;
      double      scale; ///< from SI to the unit
      Measured    figure;
    };

    const NamedFigure figures[] = {{"E", "GPa", 1e-9, &UniaxialMeasurement::modulus},
                                   {"f_t", "MPa", 1e-6, &UniaxialMeasurement::tension},
                                   {"f_c", "MPa", 1e-6, &UniaxialMeasurement::compression}};

    const UniaxialMeasurement *reference_of(const std::vector<UniaxialMeasurement> &rows, const std::string &study)
    {
      const auto found = std::find_if(rows.begin(), rows.end(), [&](const UniaxialMeasurement &row) {
        return row.which.study == study && row.which.reference;
      });
      return found == rows.end() ? nullptr : &*found;
    }

    /** Relative, with sign, against the reference of the study; the reference comes first in its study. */
    double error_of(const std::vector<UniaxialMeasurement> &rows, const UniaxialMeasurement &row, const Measured figure)
    {
      return (row.*figure).mean() / (reference_of(rows, row.which.study)->*figure).mean() - 1;
    }

    std::vector<std::string> studies_in(const std::vector<UniaxialMeasurement> &rows)
    {
      std::vector<std::string> studies;
      for (const UniaxialMeasurement &row : rows)
        if (studies.empty() || studies.back() != row.which.study)
          studies.push_back(row.which.study);
      return studies;
    }
  } // namespace

  void UniaxialMeasurement::add(const UniaxialResult &result)
  {
    if (result.load == UniaxialLoad::tension)
      {
        modulus.values.push_back(result.notes.figures.young_modulus);
        tension.values.push_back(result.notes.figures.strength);
      }
    else
      compression.values.push_back(result.notes.figures.strength);
    particles = result.at_start.particles;
    links     = result.at_start.links;
    all_steps += static_cast<double>(result.steps);
    all_seconds += result.stepping_seconds;
    const auto seeds = static_cast<double>(std::max(tension.values.size(), compression.values.size()));
    steps            = all_steps / seeds;
    seconds          = all_seconds / seeds;
  }

  std::string UniaxialMeasurement::text() const
  {
    return fmt::format("{} {} {}: E {:.2f} GPa, f_t {:.3f} MPa, f_c {:.2f} MPa, {} particles, {:.1f} s", which.study,
                       which.value, which.unit, 1e-9 * modulus.mean(), 1e-6 * tension.mean(), 1e-6 * compression.mean(),
                       particles, seconds);
  }

  void UniaxialTable::write(const BenchResults &results) const
  {
    std::string csv  = "study,value,value_of,reference,particles,links,steps,seconds [s]";
    std::string md   = "| Study | Value | Particles | Links | Steps | Cost [s] |";
    std::string line = "|---|---|---|---|---|---|";
    for (const NamedFigure &f : figures)
      {
        csv += fmt::format(",{0} [{1}],{0}_deviation [{1}],{0}_error [-]", f.name, f.unit);
        md += fmt::format(" {} [{}] | error |", f.name, f.unit);
        line += "---|---|";
      }
    csv += '\n';
    md += "\n" + line + "\n";
    for (const UniaxialMeasurement &row : rows)
      {
        csv += fmt::format("{},{},{},{},{},{},{},{}", row.which.study, row.which.value, row.which.unit,
                           row.which.reference ? 1 : 0, row.particles, row.links, row.steps, row.seconds);
        md += fmt::format("| {} | {} {} | {} | {} | {:.0f} | {:.1f} |", row.which.study, row.which.value,
                          row.which.unit, row.particles, row.links, row.steps, row.seconds);
        for (const NamedFigure &f : figures)
          {
            const Scatter &scatter = row.*f.figure;
            const double   error   = error_of(rows, row, f.figure);
            csv += fmt::format(",{},{},{}", f.scale * scatter.mean(), f.scale * scatter.deviation(), error);
            md += fmt::format(" {:.3f}{} | {} |", f.scale * scatter.mean(),
                              scatter.values.size() > 1 ? fmt::format(" ± {:.3f}", f.scale * scatter.deviation()) : "",
                              row.which.reference ? "reference" : fmt::format("{:+.2f} %", 100 * error));
          }
        csv += '\n';
        md += '\n';
      }
    results.write(csv, md);
  }

  std::vector<postprocess::PlotPanel> UniaxialTable::panels() const
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const std::string &study : studies_in(rows))
      {
        postprocess::PlotPanel panel;
        panel.title   = study;
        panel.x_label = "Cost [s]";
        panel.y_label = "Error [%]";
        panel.log_x   = true;
        panel.log_y   = true;
        for (const NamedFigure &f : figures)
          {
            postprocess::PlotSeries series;
            series.name = f.name;
            for (const UniaxialMeasurement &row : rows)
              if (row.which.study == study && !row.which.reference)
                {
                  series.x.push_back(row.seconds);
                  series.y.push_back(100 * std::abs(error_of(rows, row, f.figure)));
                }
            panel.series.push_back(series);
          }
        panels.push_back(panel);
      }
    return panels;
  }
} // namespace apps
