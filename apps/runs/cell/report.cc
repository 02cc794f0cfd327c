#include "apps/runs/cell/report.h"

#include "apps/figures/energy_terms.h"
#include "apps/figures/summary_head.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/specimens/deep_overlap.h"
#include "apps/specimens/link_classes.h"
#include "base/voigt.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

namespace apps
{
  namespace
  {
    nlohmann::json vector_of(const base::Vector6 &v) { return std::vector<double>(v.data(), v.data() + 6); }

    nlohmann::json sample_of(const dem::CellSample &s)
    {
      return {{"time", s.time}, {"strain", vector_of(s.strain)}, {"stress", vector_of(s.stress)}};
    }

    std::string text_of(const dem::StressAtEnd &end)
    {
      return fmt::format(
        "when leg {} ended, stress {} was {:.4g} Pa, with {:.4g} Pa prescribed by then, at strain {:.3g}", end.leg + 1,
        base::voigt_names[static_cast<std::size_t>(end.component)], end.is, end.requested, end.strain);
    }

    /** Component whose strain spans most. */
    int leading_component(const std::vector<dem::CellSample> &curve)
    {
      base::Vector6 low = base::Vector6::Zero(), high = low;
      for (const dem::CellSample &s : curve)
        {
          low  = low.cwiseMin(s.strain);
          high = high.cwiseMax(s.strain);
        }
      Eigen::Index at = 0;
      (high - low).maxCoeff(&at);
      return static_cast<int>(at);
    }
  } // namespace

  std::string CellReport::ended_by() const { return test.not_reached() ? "stress not reached" : "end of the path"; }

  std::string CellReport::reason() const
  {
    const dem::StressAtEnd &end   = test.stresses_at_ends().back();
    const dem::Counts       count = specimen.counts();
    return end.at_limit ? "More strain would pass Loading/Strain limit: the cell cannot carry it, or "
                          "its particles are still apart." :
           count.contacts + count.links == 0 ? "No two particles touch yet: the leg needs more time." :
                                               "The cell cannot carry it, or the leg needs more time.";
  }

  std::vector<std::string> CellReport::warnings() const
  {
    std::vector<std::string> found = tension_beyond_apex(model.material);
    for (const dem::StressAtEnd &end : test.stresses_at_ends())
      if (end.inaccurate() && !end.at_limit && !end.missed())
        found.push_back(text_of(end) + ", and more than a tenth off. A longer leg, or more Time/Damping, leaves fewer "
                                       "waves.");
    if (test.not_reached())
      found.push_back("Not reached: " + text_of(test.stresses_at_ends().back()) + ". " + reason());
    if (const std::string doubt = overlap_warning(specimen.counts().deepest_overlap); !doubt.empty())
      found.push_back(doubt);
    return found;
  }

  nlohmann::json CellReport::summary() const
  {
    base::Vector6 largest = base::Vector6::Zero(), least = largest;
    for (const dem::CellSample &s : test.curve())
      {
        largest = largest.cwiseMax(s.stress);
        least   = least.cwiseMin(s.stress);
      }
    nlohmann::json localisation = nullptr;
    if (const auto &found = test.localisation())
      localisation = {{"onset", sample_of(found->onset)},
                      {"detected", sample_of(found->detected)},
                      {"band",
                       {{"normal", {found->band.normal[0], found->band.normal[1], found->band.normal[2]}},
                        {"thickness", {{"value", found->band.thickness}, {"unit", "m"}}},
                        {"concentration", found->band.concentration}}}};
    nlohmann::json summary  = summary_head(request, "cell");
    summary["figures"]      = {{"order", base::voigt_names},
                               {"largest_stress", {{"value", vector_of(largest)}, {"unit", "Pa"}}},
                               {"least_stress", {{"value", vector_of(least)}, {"unit", "Pa"}}},
                               {"end", sample_of(test.curve().back())}};
    summary["localisation"] = localisation;
    summary["ended_by"]     = ended_by();
    summary["warnings"]     = warnings();
    summary["energy"]       = json_of(specimen.energy(), worst_balance_error);
    summary["cost"]         = {{"particles", specimen.counts().particles},
                               {"links", specimen.counts().links},
                               {"steps", specimen.steps()},
                               {"threads", omp_get_max_threads()},
                               {"wall_seconds", wall_seconds}};
    materials.put_into(summary);
    const LinkClasses classes(model.mixed().link_classes(packing.material_names));
    if (const nlohmann::json by_class = classes.json(classes.figures(specimen)); !by_class.empty())
      summary["link_classes"] = by_class;
    model.mixed().put_into(summary, packing.periodic_cell);
    return summary;
  }

  std::string CellReport::draw_curve(const std::filesystem::path &file) const
  {
    const int              lead = leading_component(test.curve());
    postprocess::PlotPanel panel;
    panel.title   = "periodic cell";
    panel.x_label = fmt::format("Strain {} [1e-3]", base::voigt_names[lead]);
    panel.y_label = "Stress [MPa]";
    for (int c = 0; c < 6; ++c)
      {
        if (model.physics.dimension == 2 && c >= 2 && c < 5)
          continue;
        postprocess::PlotSeries series;
        series.name  = base::voigt_names[c];
        series.style = postprocess::PlotSeries::Style::line;
        for (const dem::CellSample &s : test.curve())
          {
            series.x.push_back(1e3 * s.strain[lead]);
            series.y.push_back(1e-6 * s.stress[c]);
          }
        panel.series.push_back(series);
      }
    return postprocess::plot(file, {panel});
  }

  std::string CellReport::text() const
  {
    const dem::CellSample &end = test.curve().back();
    std::string            text;
    for (int c = 0; c < 6; ++c)
      text += fmt::format("{}           strain {:>12.4e}  stress {:>12.5g} MPa\n", base::voigt_names[c], end.strain[c],
                          1e-6 * end.stress[c]);
    if (const auto &found = test.localisation())
      text += fmt::format(
        "localised    from time {:.4g} s, in a band {:.3g} m thick with normal ({:.2f}, {:.2f}, {:.2f}): from "
        "there the average over the cell is no material property\n",
        found->onset.time, found->band.thickness, found->band.normal[0], found->band.normal[1], found->band.normal[2]);
    text += fmt::format("ended by     {}\n", ended_by());
    text += warning_lines(warnings());
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balance_error);
    text += fmt::format("cost         {}, {} steps with {} threads\n", duration_text(wall_seconds), specimen.steps(),
                        omp_get_max_threads());
    return text;
  }
} // namespace apps
