#include "apps/drivers/sequential_study.h"

#include "postprocess/csv_table.h"
#include "postprocess/plot.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    constexpr const char *grey = "#9a9a9a", *black = "#000000";

    /** Linear between samples whose abscissae grow in magnitude; NaN outside. */
    double interpolated(const std::vector<double> &x, const std::vector<double> &y, const double at)
    {
      for (std::size_t i = 1; i < x.size(); ++i)
        if ((at - x[i - 1]) * (at - x[i]) <= 0 && x[i] != x[i - 1])
          return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
      return std::numeric_limits<double>::quiet_NaN();
    }

    std::vector<double> scaled(std::vector<double> values, const double by)
    {
      for (double &v : values)
        v *= by;
      return values;
    }

    nlohmann::json quantity(const double value, const char *unit) { return {{"value", value}, {"unit", unit}}; }
  } // namespace

  double ContinuationCurve::peak() const
  {
    double largest = 0;
    for (const double v : vertical)
      largest = std::max(largest, std::abs(v));
    return largest;
  }

  double ContinuationCurve::horizontal_at_peak() const
  {
    const auto at =
      std::max_element(vertical.begin(), vertical.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return vertical.empty() ? 0 : horizontal[static_cast<std::size_t>(at - vertical.begin())];
  }

  ContinuationCurve read_continuation(const SequentialModel::Study &study, const std::filesystem::path &folder)
  {
    const postprocess::CsvTable table = postprocess::read_csv_table(folder / "series.csv", true);
    ContinuationCurve           curve;
    curve.horizontal = scaled(table.column(study.horizontal), study.sign / study.length);
    curve.vertical   = scaled(table.column(study.vertical), study.sign / study.area);
    curve.dissipated = table.column("energy_dissipated");
    return curve;
  }

  double error_against(const ContinuationCurve &curve, const ParticleOutcome &all_particles)
  {
    // Both at the strains of the particles' samples past the transfer: their steps are equal.
    double      difference = 0, size = 0;
    std::size_t common = 0;
    for (std::size_t i = 0; i < all_particles.curve_strain.size(); ++i)
      {
        const double local = all_particles.curve_strain[i] - curve.offset;
        if (local * all_particles.curve_strain[i] < 0)
          continue;
        const double there = interpolated(curve.horizontal, curve.vertical, local);
        if (!std::isfinite(there))
          continue;
        difference += std::abs(there - all_particles.curve_stress[i]);
        size += std::abs(all_particles.curve_stress[i]);
        ++common;
      }
    return common > 0 && size > 0 ? difference / size : std::numeric_limits<double>::quiet_NaN();
  }

  std::string StudyReport::csv() const
  {
    std::string text =
      "case,event,severity,absorbed [J],particle_stress [Pa],particle_seconds,balance_error,peak,horizontal_at_peak,"
      "dissipated [J],continuum_seconds,error_against_all_particles\n";
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        const ContinuationCurve &c = curves[k];
        const ParticleOutcome   &p = particles[k];
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", k, p.name, p.severity, p.absorbed, p.stress,
                            p.seconds, p.balance_error, c.peak(), c.horizontal_at_peak(), c.energy(), c.seconds,
                            all_particles ? error_against(c, *all_particles) : std::nan(""));
      }
    return text;
  }

  std::string StudyReport::draw(const std::filesystem::path &file) const
  {
    const bool                          stresses = model.particles.source == ParticleStageSection::Source::uniaxial;
    const double                        up       = stresses && model.particles.compresses() ? -1 : 1;
    std::vector<postprocess::PlotPanel> panels;
    postprocess::PlotPanel              together;
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        postprocess::PlotSeries after;
        after.style  = postprocess::PlotSeries::Style::line;
        after.colour = black;
        after.name   = "continuum";
        for (std::size_t i = 0; i < curves[k].horizontal.size(); ++i)
          {
            after.x.push_back(stresses ? up * 1e3 * (curves[k].offset + curves[k].horizontal[i]) :
                                         curves[k].horizontal[i]);
            after.y.push_back(stresses ? up * 1e-6 * curves[k].vertical[i] : curves[k].vertical[i]);
          }
        if (!stresses)
          {
            after.colour.clear();
            after.name = particles[k].name;
            together.series.push_back(after);
            continue;
          }
        postprocess::PlotSeries before;
        before.style  = postprocess::PlotSeries::Style::line;
        before.colour = grey;
        before.name   = "particles";
        before.x      = scaled(particles[k].curve_strain, up * 1e3);
        before.y      = scaled(particles[k].curve_stress, up * 1e-6);
        postprocess::PlotPanel panel;
        panel.title   = "handed over at " + particles[k].name;
        panel.x_label = "Strain [1e-3]";
        panel.y_label = "Stress [MPa]";
        if (all_particles)
          {
            postprocess::PlotSeries reference;
            reference.style  = postprocess::PlotSeries::Style::line;
            reference.colour = "#d0d0d0";
            reference.x      = scaled(all_particles->curve_strain, up * 1e3);
            reference.y      = scaled(all_particles->curve_stress, up * 1e-6);
            panel.series.push_back(reference);
          }
        panel.series.push_back(before);
        panel.series.push_back(after);
        panels.push_back(panel);
      }
    if (!together.series.empty())
      {
        together.title   = "Continuations";
        together.x_label = model.study.horizontal;
        together.y_label = model.study.vertical;
        panels.push_back(together);
      }
    postprocess::PlotPanel  rest;
    postprocess::PlotSeries left;
    left.style = postprocess::PlotSeries::Style::line_and_points;
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        left.x.push_back(stresses ? up * 1e3 * particles[k].severity : particles[k].severity);
        left.y.push_back((stresses ? 1e-6 : 1.0) * curves[k].peak());
      }
    rest.title   = "What the continuum still carries";
    rest.x_label = stresses ? "Strain reached by the particles [1e-3]" : "Energy of the blow [J]";
    rest.y_label = stresses ? "Largest stress [MPa]" : "Largest " + model.study.vertical;
    if (stresses)
      left.style = postprocess::PlotSeries::Style::points; // monotonic and unloaded states at the same strain
    rest.series = {left};
    panels.push_back(rest);
    return postprocess::plot(file, panels);
  }

  nlohmann::json StudyReport::json() const
  {
    nlohmann::json cases = nlohmann::json::array();
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        nlohmann::json one = {{"event", particles[k].name},
                              {"severity", particles[k].severity},
                              {"particle_balance_error", particles[k].balance_error},
                              {"peak", curves[k].peak()},
                              {"horizontal_at_peak", curves[k].horizontal_at_peak()},
                              {"dissipated", quantity(curves[k].energy(), "J")},
                              {"particle_seconds", particles[k].seconds},
                              {"continuum_seconds", curves[k].seconds}};
        if (model.particles.source == ParticleStageSection::Source::impact)
          one["absorbed"] = quantity(particles[k].absorbed, "J");
        if (model.particles.source == ParticleStageSection::Source::uniaxial)
          one["stress"] = quantity(particles[k].stress, "Pa");
        if (particles[k].start)
          one["initial_equilibrium"] = json_of(*particles[k].start);
        if (all_particles)
          one["error_against_all_particles"] = error_against(curves[k], *all_particles);
        cases.push_back(one);
      }
    return cases;
  }

  std::string StudyReport::text() const
  {
    std::string text = fmt::format("{:<22} {:>12} {:>14} {:>14}{}\n", "event", "peak", "at", "dissipated [J]",
                                   all_particles ? "  error against all particles" : "");
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        text += fmt::format("{:<22} {:>12.4g} {:>14.4g} {:>14.4g}", particles[k].name, curves[k].peak(),
                            curves[k].horizontal_at_peak(), curves[k].energy());
        if (all_particles)
          text += fmt::format("  {:.3f}", error_against(curves[k], *all_particles));
        text += '\n';
      }
    return text;
  }
} // namespace apps
