#include "apps/figures/motion_report.h"

#include "apps/figures/series_figures.h"
#include "apps/figures/summary_head.h"
#include "apps/specimens/deep_overlap.h"
#include "apps/specimens/left_out_of_balance.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

namespace apps
{
  std::vector<std::string> MotionReport::doubts() const
  {
    const dem::Counts        counts = specimen.counts();
    std::vector<std::string> all    = warnings;
    for (const std::string &doubt : {overlap_warning(counts.deepest_overlap), turn_warning(counts.largest_turn)})
      if (!doubt.empty())
        all.push_back(doubt);
    return all;
  }

  double MotionReport::balance_error() const { return worst_residual(series, specimen.energy().rounding); }

  nlohmann::json MotionReport::summary(const nlohmann::json &figures, nlohmann::json energy, nlohmann::json cost) const
  {
    energy["balance_error"] = balance_error();
    energy["unit"]          = "J";
    if (!not_in_balance.empty())
      energy["not_in_balance"] = not_in_balance;
    cost["threads"]        = omp_get_max_threads();
    nlohmann::json summary = summary_head(request, kind);
    summary["ended_by"]    = ended_by;
    summary["end_time"]    = quantity(end_time, "s");
    summary["figures"]     = figures;
    summary["energy"]      = std::move(energy);
    summary["cost"]        = std::move(cost);
    summary["warnings"]    = doubts();
    if (!notes.empty())
      summary["notes"] = notes;
    materials.put_into(summary);
    if (start)
      summary["initial_equilibrium"] = json_of(*start);
    return summary;
  }

  std::string MotionReport::text() const
  {
    std::string text = fmt::format("ended by     {}, at {:.6g} s\n", ended_by, end_time);
    if (start)
      text += fmt::format("start        {}\n", text_of(*start));
    for (const std::string &note : notes)
      text += fmt::format("note         {}\n", note);
    text += fmt::format("energy       balance error {:.1e} of the largest energy\n", balance_error());
    return text + warning_lines(doubts()) + balance_note(not_in_balance);
  }
} // namespace apps
