#include "apps/runs/continuum/summary.h"

#include "apps/figures/drawn_curve.h"
#include "apps/figures/series_figures.h"
#include "apps/figures/summary_head.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/results/warning.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double worrying_balance = 0.05;

    /** Where neighbours disagree by more, finer elements find more at their largest stress (doc/tutorials/plate_with_hole.md). */
    constexpr double worrying_disagreement = 0.05;

    nlohmann::json figure_of(const fem::Extreme &largest, const char *unit)
    {
      return {{"value", largest.value}, {"unit", unit}, {"at", largest.place}};
    }

    std::string text_of(const std::array<double, 3> &place)
    {
      return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", place[0], place[1], place[2]);
    }
  } // namespace

  double ContinuumReport::last(const std::string &column) const { return series.column(column).back(); }

  std::vector<std::string> ContinuumReport::warnings() const
  {
    std::vector<std::string> found;
    if (contact && !contact->touched())
      found.push_back("no bodies have ever touched");
    if (contact && !contact->doubt().empty())
      found.push_back(contact->doubt());
    if (!doubt.empty())
      found.push_back(doubt);
    const double error = worst_residual(series);
    if (error > worrying_balance)
      found.push_back(
        fmt::format("the energies do not balance by {:.0f} % of the largest: {}", 100 * error,
                    is_static ? "the steps are too long for the work that they count. Shorten Control/Largest step; "
                                "where the load falls at once (snap-back) no step is short enough: set "
                                "Control/Follow = indirect or arc length" :
                                "the motion is not resolved. Lower Motion/Safety"));
    if (extremes && is_linear && extremes->disagreement > worrying_disagreement)
      found.push_back(fmt::format("the mesh is coarse at the largest stress, {:.4g} Pa (von Mises) at {}: elements "
                                  "that meet there disagree by {:.0f} % of it. Refine "
                                  "the mesh there until it stands still; in a sharp corner, and at the end of a "
                                  "clamped face, it has no largest value",
                                  extremes->mises.value, text_of(extremes->mises.place), 100 * extremes->disagreement));
    return found;
  }

  nlohmann::json ContinuumReport::figures() const
  {
    nlohmann::json     found;
    const std::string &clock = series.names.front();
    const auto         has   = [this](const std::string &name) {
      return std::count(series.names.begin(), series.names.end(), name) > 0;
    };
    const bool has_opening = has("opening");
    const auto tell_peak   = [&](const postprocess::SeriesColumn &column) {
      const auto       &values = series.column(column.name);
      const std::size_t row    = peak_row(values);
      nlohmann::json   &peak   = found["peak_" + column.name];
      peak                     = quantity(values[row], column.unit);
      peak["at_" + clock]      = series.columns[0][row];
      if (has_opening)
        peak["at_opening"] = series.column("opening")[row];
    };
    if (has("load_factor"))
      tell_peak({"load_factor", "-"});
    for (const ProbeColumn &probe : probes)
      {
        if (probe.reported == ProbeColumn::Reported::peak)
          tell_peak(probe.column);
        if (probe.reported == ProbeColumn::Reported::last)
          found[probe.reported_as] = quantity(last(probe.column.name), probe.column.unit);
      }
    if (has_opening)
      found["final_opening"] = quantity(last("opening"), "m");
    if (fracture_zone_width)
      found["fracture_zone_width"] = quantity(*fracture_zone_width, "m");
    if (contact && contact->touched())
      contact->put_into(found, references);
    if (extremes)
      {
        found["largest_principal_stress"]                       = figure_of(extremes->tension, "Pa");
        found["least_principal_stress"]                         = figure_of(extremes->compression, "Pa");
        found["largest_mises_stress"]                           = figure_of(extremes->mises, "Pa");
        found["largest_mises_stress"]["neighbours_disagree_by"] = extremes->disagreement;
        found["largest_displacement"]                           = figure_of(extremes->displacement, "m");
      }
    return found;
  }

  nlohmann::json ContinuumReport::summary() const
  {
    nlohmann::json summary = summary_head(request, "continuum");
    summary["ended_by"]    = ended_by;
    summary["figures"]     = figures();
    summary["warnings"]    = warnings();
    if (!notes.empty())
      summary["notes"] = notes;
    summary["cost"] = {{"elements", size.elements},
                       {"unknowns", size.unknowns},
                       {"integration_points", size.points},
                       {"ranks", rank_count()},
                       {"wall_seconds", wall_seconds}};
    for (const auto &[name, value] : cost)
      summary["cost"][name] = value;
    if (!linear_solver.empty())
      summary["cost"]["linear_solver"] = linear_solver;
    if (!is_static && cost.at("stepping_seconds") > 0)
      summary["cost"]["point_updates_per_second"] = cost.at("steps") * size.points / cost.at("stepping_seconds");
    summary["energy"] = {{"balance_error", worst_residual(series)}, {"unit", "J"}};
    for (const std::string &name : series.names)
      if (name.rfind("energy_", 0) == 0 && name != "energy_balance_error")
        summary["energy"][name.substr(7)] = last(name);
    return summary;
  }

  std::string ContinuumReport::text() const
  {
    std::string          text;
    const nlohmann::json found = figures();
    for (const auto &[name, figure] : found.items())
      text +=
        fmt::format("{:<40} {:.6g} {}{}\n", name, figure["value"].get<double>(), figure["unit"].get<std::string>(),
                    figure.contains("at") ? " at " + text_of(figure["at"].get<std::array<double, 3>>()) : "");
    if (contact && contact->touched())
      text += contact->text("bodies");
    for (const std::string &note : notes)
      text += fmt::format("note         {}\n", note);
    text += warning_lines(warnings());
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_residual(series));
    text += fmt::format("cost         {}, {:.0f} steps{}\n", duration_text(wall_seconds), cost.at("steps"),
                        linear_solver.empty() ? "" : ", " + linear_solver);
    return text;
  }
} // namespace apps
