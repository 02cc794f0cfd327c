#include "apps/bench/size_effect_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** Of each size and kind the first beam that stands for it, in the order in which they were broken. */
    std::vector<BrokenBeam> first_of_each(const std::vector<BrokenBeam> &all, const bool all_particles)
    {
      std::vector<BrokenBeam> found;
      for (const BrokenBeam &b : all)
        if (b.of.all_particles == all_particles &&
            std::none_of(found.begin(), found.end(), [&b](const BrokenBeam &other) {
              return other.of.size == b.of.size && other.of.notched == b.of.notched;
            }))
          found.push_back(b);
      return found;
    }

    const char *kind_of(const bool notched) { return notched ? "notched" : "smooth"; }

    std::string off(const std::function<double(double)> &law, const double depth, const double strength)
    {
      return law ? fmt::format("{:.2f} ({:+.1f} %)", 1e-6 * law(depth), 100 * (law(depth) / strength - 1)) : "-";
    }

    std::string rows_of_sizes(const std::vector<BrokenBeam> &all, const SizeEffectAnswer &answer)
    {
      std::string md =
                    "| Beam | D [mm] | Strength [MPa] | Work over ligament [J/m²] | Overlap damaged [%] | Particles | "
                    "Cost [s] |",
                  line = "|---|---|---|---|---|---|---|";
      for (const NamedLaw &law : answer.laws)
        {
          md += " " + law.name + " |";
          line += "---|";
        }
      md += "\n" + line + "\n";
      for (const BrokenBeam &b : first_of_each(all, false))
        {
          const auto         of = [&](double BrokenBeam::*member) { return figure_of(all, b.of, member); };
          const FigureOfSize s = of(&BrokenBeam::strength), w = of(&BrokenBeam::work);
          md += fmt::format("| {} | {:g} | {:.3f} ± {:.3f} | {} | {:.1f} | {:.0f} | {:.0f} |", kind_of(b.of.notched),
                            1e3 * b.depth, 1e-6 * s.mean, 1e-6 * s.deviation,
                            b.of.whole ? fmt::format("{:.1f} ± {:.1f}", w.mean, w.deviation) : "-",
                            100 * of(&BrokenBeam::shared).mean, b.particles, of(&BrokenBeam::cost).mean);
          for (const NamedLaw &law : answer.laws)
            md += " " + off(law.of(b.of.notched), b.depth, s.mean) + " |";
          md += "\n";
        }
      return md;
    }

    std::string rows_of_particles(const std::vector<BrokenBeam> &all, const SizeEffectAnswer &answer)
    {
      const std::vector<BrokenBeam> alone = first_of_each(all, true);
      if (alone.empty())
        return "";
      std::string md =
        fmt::format("\nAll of particles, beside the same particles with elements around them:\n\n| Beam | D "
                    "[mm] | Strength [MPa] | Particles | Cost [s] | With elements | {0} | the model, {0} |\n"
                    "|---|---|---|---|---|---|---|---|\n",
                    answer.laws.back().name);
      for (const BrokenBeam &b : alone)
        {
          BeamCase with               = b.of;
          with.all_particles          = false;
          const FigureOfSize direct   = figure_of(all, b.of, &BrokenBeam::strength),
                             elements = figure_of(all, with, &BrokenBeam::strength);
          const auto model            = [&](const double) { return answer.model * elements.mean; };
          md += fmt::format("| {} | {:g} | {:.3f} ± {:.3f} | {:.0f} | {:.0f} | {:.3f} ({:+.1f} %) | {} | {} |\n",
                            kind_of(b.of.notched), 1e3 * b.depth, 1e-6 * direct.mean, 1e-6 * direct.deviation,
                            b.particles, figure_of(all, b.of, &BrokenBeam::cost).mean, 1e-6 * elements.mean,
                            100 * (elements.mean / direct.mean - 1),
                            off(answer.laws.back().of(b.of.notched), b.depth, direct.mean),
                            std::isfinite(answer.model) ? off(model, b.depth, direct.mean) : "-");
        }
      return md;
    }

    postprocess::PlotSeries points_of(const std::vector<BrokenBeam> &all, const bool notched, const bool all_particles)
    {
      postprocess::PlotSeries points;
      points.name  = all_particles ? "all of particles" : "beams";
      points.style = postprocess::PlotSeries::Style::points;
      for (const BrokenBeam &b : all)
        if (b.of.notched == notched && b.of.all_particles == all_particles)
          {
            points.x.push_back(1e3 * b.depth);
            points.y.push_back(1e-6 * b.strength);
          }
      return points;
    }

    postprocess::PlotPanel
    panel_of(const std::vector<BrokenBeam> &all, const SizeEffectAnswer &answer, const bool notched)
    {
      postprocess::PlotPanel panel;
      panel.title   = notched ? "with a notch of 0.3 D" : "without a notch";
      panel.x_label = "Depth [mm]";
      panel.y_label = "Nominal strength [MPa]";
      panel.log_x = panel.log_y = true;
      for (const bool alone : {false, true})
        if (postprocess::PlotSeries points = points_of(all, notched, alone); !points.x.empty())
          panel.series.push_back(std::move(points));
      if (panel.series.empty())
        return panel;
      const std::vector<double> &depths = panel.series.front().x;
      const double               from   = *std::min_element(depths.begin(), depths.end()) / 1.5,
                   to                   = *std::max_element(depths.begin(), depths.end()) * 1.5;
      for (const NamedLaw &law : answer.laws)
        {
          if (!law.of(notched))
            continue;
          postprocess::PlotSeries line;
          line.name  = law.name;
          line.style = postprocess::PlotSeries::Style::line;
          for (int k = 0; k <= 40; ++k)
            {
              line.x.push_back(from * std::pow(to / from, k / 40.0));
              line.y.push_back(1e-6 * law.of(notched)(1e-3 * line.x.back()));
            }
          panel.series.push_back(line);
        }
      return panel;
    }
  } // namespace

  std::string csv_of_beams(const std::vector<BrokenBeam> &all)
  {
    std::string csv =
      "size,geometry,notched,all_particles,depth [m],nominal_strength [Pa],work_over_ligament [J/m^2],load_left [-],"
      "particles,points,overlap_damaged [-],balance_error [-],cost [s]\n";
    for (const BrokenBeam &b : all)
      csv += fmt::format("{},{},{:d},{:d},{},{},{},{},{},{},{},{},{}\n", b.of.size, b.of.geometry, b.of.notched,
                         b.of.all_particles, b.depth, b.strength, b.work, b.left, b.particles, b.points, b.shared,
                         b.balance, b.cost);
    return csv;
  }

  std::string table_of_sizes(const std::vector<BrokenBeam> &all, const SizeEffectAnswer &answer)
  {
    std::string md =
      "Nominal strength 3PS/(2bD²), means and standard deviations over geometries; work of those that were "
      "followed to the end.\n\n" +
      rows_of_sizes(all, answer) + rows_of_particles(all, answer);
    for (const std::string &line : answer.words)
      md += "\n" + line + "\n";
    return md;
  }

  std::vector<postprocess::PlotPanel> panels_of_sizes(const std::vector<BrokenBeam> &all,
                                                      const SizeEffectAnswer        &answer)
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const bool notched : {true, false})
      if (postprocess::PlotPanel panel = panel_of(all, answer, notched); !panel.series.empty())
        panels.push_back(std::move(panel));
    return panels;
  }
} // namespace apps
