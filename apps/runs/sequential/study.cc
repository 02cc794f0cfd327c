#include "apps/runs/sequential/study.h"

#include "apps/figures/summary_head.h"
#include "apps/runs/continuum/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
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

  } // namespace

  double ContinuationCurve::peak() const
  {
    double largest = std::nan("");
    for (const double v : vertical)
      largest = std::fmax(largest, std::abs(v));
    return largest;
  }

  double ContinuationCurve::horizontal_at_peak() const
  {
    const auto at =
      std::max_element(vertical.begin(), vertical.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return vertical.empty() ? std::nan("") : horizontal[static_cast<std::size_t>(at - vertical.begin())];
  }

  double ContinuationCurve::furthest() const { return horizontal.empty() ? std::nan("") : horizontal.back(); }

  double ContinuationCurve::energy() const { return dissipated.empty() ? std::nan("") : dissipated.back(); }

  bool ContinuationCurve::broke_off() const { return ended_by.rfind(no_equilibrium, 0) == 0; }

  ContinuationCurve curve_of(const SequentialModel::Study &study, const RunResult &continuation)
  {
    ContinuationCurve curve;
    curve.ended_by = continuation.summary.at("ended_by");
    curve.seconds  = continuation.summary.at("cost").at("wall_seconds");
    if (continuation.series.names.empty()) // no equilibrium at the hand-over
      return curve;
    curve.horizontal = scaled(continuation.series.column(study.horizontal), study.sign / study.length);
    curve.vertical   = scaled(continuation.series.column(study.vertical), study.sign / study.area);
    curve.dissipated = continuation.series.column("energy_dissipated");
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

  namespace
  {
    constexpr double near_after = 0.5; ///< past the transfer, over its strain
  }

  double near_reaches(const ContinuationCurve &curve)
  {
    double furthest = 0;
    for (const double x : curve.horizontal)
      furthest = std::max(furthest, std::abs(x));
    return 1 + std::min(near_after, furthest / std::abs(curve.offset));
  }

  ContinuationCurve near_the_transfer(ContinuationCurve curve)
  {
    const double      reach = near_after * std::abs(curve.offset);
    const std::size_t end   = static_cast<std::size_t>(
      std::find_if(curve.horizontal.begin(), curve.horizontal.end(), [&](double x) { return std::abs(x) > reach; }) -
      curve.horizontal.begin());
    curve.horizontal.resize(end);
    curve.vertical.resize(end);
    return curve;
  }

  std::string StudyReport::csv() const
  {
    const std::string h = " [" + units.horizontal + "]", v = " [" + units.vertical + "]";
    std::string       text =
      "case,event,severity [" + severity_unit() +
      "],absorbed [J],particle_stress [Pa],particle_seconds [s],balance_error [-],peak" + v + ",horizontal_at_peak" +
      h + ",furthest" + h + ",dissipated [J],continuum_seconds [s],broke_off" +
      (all_particles ? ",error_against_all_particles [-],error_near [-],near_reaches [strains of the transfer]\n" :
                       "\n");
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        const ContinuationCurve &c = curves[k];
        const ParticleOutcome   &p = particles[k];
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", k, p.name, p.severity, p.absorbed, p.stress,
                            p.seconds, p.balance_error, c.peak(), c.horizontal_at_peak(), c.furthest(), c.energy(),
                            c.seconds, c.broke_off() ? 1 : 0);
        text += all_particles ? fmt::format(",{},{},{}\n", error_against(c, *all_particles),
                                            error_against(near_the_transfer(c), *all_particles), near_reaches(c)) :
                                "\n";
      }
    return text;
  }

  nlohmann::json StudyReport::json() const
  {
    nlohmann::json cases = nlohmann::json::array();
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        nlohmann::json one = {{"event", particles[k].name},
                              {"severity", particles[k].severity},
                              {"particle_balance_error", particles[k].balance_error},
                              {"ended_by", curves[k].ended_by},
                              {"peak", quantity(curves[k].peak(), units.vertical)},
                              {"horizontal_at_peak", quantity(curves[k].horizontal_at_peak(), units.horizontal)},
                              {"furthest", quantity(curves[k].furthest(), units.horizontal)},
                              {"dissipated", quantity(curves[k].energy(), "J")},
                              {"particle_seconds", particles[k].seconds},
                              {"continuum_seconds", curves[k].seconds}};
        if (model.particles.source == ParticleEventSection::Source::impact)
          one["absorbed"] = quantity(particles[k].absorbed, "J");
        if (model.particles.source == ParticleEventSection::Source::uniaxial)
          one["stress"] = quantity(particles[k].stress, "Pa");
        if (particles[k].start)
          one["initial_equilibrium"] = json_of(*particles[k].start);
        if (all_particles)
          {
            one["error_against_all_particles"] = error_against(curves[k], *all_particles);
            one["error_near"]                  = error_against(near_the_transfer(curves[k]), *all_particles);
            one["near_reaches"]                = near_reaches(curves[k]);
          }
        cases.push_back(one);
      }
    return cases;
  }

  std::string StudyReport::severity_unit() const
  {
    using Source = ParticleEventSection::Source;
    return model.particles.source == Source::impact ? "J" : model.particles.source == Source::uniaxial ? "-" : "";
  }

  std::string StudyReport::how_it_ended(const ContinuationCurve &curve) const
  {
    const std::string place = fmt::format("{:.4g} [{}]", curve.furthest(), units.horizontal);
    if (curve.broke_off())
      return curve.horizontal.empty() ? "no equilibrium at the hand-over" : "no equilibrium beyond " + place;
    return curve.ended_by == softened ? softened + ", left at " + place : curve.ended_by;
  }

  std::string StudyReport::text() const
  {
    const std::string h = " [" + units.horizontal + "]", v = " [" + units.vertical + "]";
    std::string text = fmt::format("{:<22} {:>13} {:>13} {:>15} {:>8}{}  ended by\n", "event", "peak" + v, "at" + h,
                                   "dissipated [J]", "time [s]", all_particles ? "  error [-]  near [-]  up to" : "");
    std::string failures;
    for (std::size_t k = 0; k < curves.size(); ++k)
      {
        const ContinuationCurve &c = curves[k];
        text += fmt::format("{:<22} {:>13.4g} {:>13.4g} {:>15.4g} {:>8.2f}", particles[k].name, c.peak(),
                            c.horizontal_at_peak(), c.energy(), c.seconds);
        if (all_particles)
          text += fmt::format("  {:>9.3f}  {:>8.3f}  {:>5.2f}", error_against(c, *all_particles),
                              error_against(near_the_transfer(c), *all_particles), near_reaches(c));
        text += "  " + how_it_ended(c) + "\n";
        if (c.broke_off())
          failures += fmt::format("  {}: {}\n", particles[k].name, c.ended_by);
      }
    if (all_particles)
      text +=
        "error: mean |stress - stress of all particles| over the mean of the latter, past the hand-over, as far as the "
        "continuation came;\nnear: no further than 1.5 times the strain of the hand-over; up to: how many times that "
        "strain it came\n";
    if (!failures.empty())
      text += "continuations that broke off:\n" + failures;
    return text + warning_lines(warnings());
  }
} // namespace apps
