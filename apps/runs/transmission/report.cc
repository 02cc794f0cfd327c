#include "apps/runs/transmission/report.h"

#include "apps/figures/summary_head.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  std::string csv_of_waves(const std::vector<WavePoint> &points)
  {
    std::string text = "method,wavelength [m],reflected [-],transmitted [-],absorbed [-]\n";
    for (const WavePoint &p : points)
      text += fmt::format("{},{},{},{},{}\n", p.method, p.wavelength, p.answer.reflected, p.answer.transmitted,
                          p.answer.absorbed);
    return text;
  }

  nlohmann::json json_of_waves(const std::vector<WavePoint> &points)
  {
    nlohmann::json all = nlohmann::json::array();
    for (const WavePoint &p : points)
      all.push_back({{"method", p.method},
                     {"wavelength", {{"value", p.wavelength}, {"unit", "m"}}},
                     {"reflected", p.answer.reflected},
                     {"transmitted", p.answer.transmitted},
                     {"absorbed", p.answer.absorbed},
                     {"made", p.answer.made},
                     {"unhindered", p.answer.unhindered},
                     {"left_behind", p.answer.left_behind},
                     {"left_behind_alone", p.answer.left_behind_alone},
                     {"cost", p.answer.cost},
                     {"balance_error", p.answer.balance_error},
                     {"steps", p.answer.steps},
                     {"particles", p.answer.particles}});
    return all;
  }

  nlohmann::json figures_of_waves(const std::vector<WavePoint> &points)
  {
    nlohmann::json all = nlohmann::json::array();
    for (const WavePoint &p : points)
      all.push_back({{"reflected", quantity(p.answer.reflected, "-")},
                     {"transmitted", quantity(p.answer.transmitted, "-")},
                     {"absorbed", quantity(p.answer.absorbed, "-")}});
    return {{"waves", all}};
  }

  std::vector<postprocess::PlotPanel> wave_panels(const std::vector<WavePoint> &points,
                                                  const coupling::WaveCase     &common)
  {
    const std::pair<const char *, double coupling::WaveAnswer::*> shares[] = {
      {"Reflected", &coupling::WaveAnswer::reflected},
      {"Transmitted", &coupling::WaveAnswer::transmitted},
      {"Absorbed", &coupling::WaveAnswer::absorbed}};
    std::vector<postprocess::PlotPanel> panels;
    for (const auto &[title, share] : shares)
      {
        postprocess::PlotPanel panel;
        panel.title   = fmt::format("{}, elements of {} spacings", title, common.element);
        panel.x_label = "Wavelength / spacing of the particles";
        panel.y_label = "Share of the energy";
        panel.log_x   = true;
        for (const WavePoint &p : points)
          {
            if (panel.series.empty() || panel.series.back().name != p.method)
              {
                panel.series.emplace_back();
                panel.series.back().name = p.method;
              }
            panel.series.back().x.push_back(p.wavelength / common.medium.spacing);
            panel.series.back().y.push_back(p.answer.*share);
          }
        if (share == &coupling::WaveAnswer::reflected && common.medium.lattice == coupling::WaveMedium::Lattice::chain)
          {
            postprocess::PlotSeries reference;
            reference.name                 = "no overlap, exact";
            reference.style                = postprocess::PlotSeries::Style::line;
            reference.colour               = "#000000";
            const auto [shortest, longest] = std::minmax_element(
              points.begin(), points.end(), [](const auto &a, const auto &b) { return a.wavelength < b.wavelength; });
            constexpr int between = 200;
            for (int i = 0; i <= between; ++i)
              {
                const double lambda =
                  shortest->wavelength *
                  std::pow(longest->wavelength / shortest->wavelength, static_cast<double>(i) / between) /
                  common.medium.spacing;
                reference.x.push_back(lambda);
                reference.y.push_back(coupling::edge_to_edge_reflection(common.element, lambda));
              }
            panel.series.push_back(reference);
          }
        panels.push_back(panel);
      }
    return panels;
  }
} // namespace apps
