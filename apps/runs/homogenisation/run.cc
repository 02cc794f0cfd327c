#include "apps/runs/homogenisation/run.h"

#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/process/version.h"
#include "apps/results/short_run.h"
#include "apps/results/warning.h"
#include "apps/runs/homogenisation/report.h"
#include "dem/ranks/ranks.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <tuple>

namespace apps
{
  namespace
  {
    /** One case of the sweep, over all packings. */
    struct SweepPoint
    {
      double                            interaction_ratio, shear_ratio;
      std::vector<HomogenisationAnswer> answers;

      /** Over those packings that have the constant. */
      statistics::SampleMoments figure(FoundStiffness HomogenisationAnswer::*way,
                                       double dem::ElasticConstants::*constant) const
      {
        return moments_of(answers, way, constant);
      }
    };

    /** Means over packings, of each case in each way. */
    nlohmann::json figures_of(const std::vector<SweepPoint> &points)
    {
      nlohmann::json cases = nlohmann::json::array();
      for (const SweepPoint &p : points)
        {
          nlohmann::json &own = cases.emplace_back();
          for (const HomogenisationWay &way : homogenisation_ways)
            for (const auto &[name, constant, unit] : {std::tuple("young_modulus", &dem::ElasticConstants::young, "Pa"),
                                                       {"poisson_ratio", &dem::ElasticConstants::poisson, "-"}})
              {
                const auto sample   = p.figure(way.found, constant);
                own[way.name][name] = {{"value", nullptr}, {"unit", unit}};
                if (sample.count > 0)
                  own[way.name][name]["value"] = sample.mean;
                else
                  own[way.name][name]["not_determined"] = "the cell does not resist every strain";
              }
        }
      return {{"cases", cases}};
    }

    std::string csv_of(const std::vector<SweepPoint> &points)
    {
      std::string text = "interaction_ratio,shear_ratio";
      for (const HomogenisationWay &way : homogenisation_ways)
        text += fmt::format(",{0}_E [Pa],{0}_E_deviation [Pa],{0}_nu,{0}_nu_deviation", way.name);
      text += '\n';
      for (const SweepPoint &p : points)
        {
          text += fmt::format("{},{}", p.interaction_ratio, p.shear_ratio);
          for (const HomogenisationWay &way : homogenisation_ways)
            {
              const auto E  = p.figure(way.found, &dem::ElasticConstants::young);
              const auto nu = p.figure(way.found, &dem::ElasticConstants::poisson);
              text += E.count > 0 ? fmt::format(",{},{},{},{}", E.mean, E.deviation, nu.mean, nu.deviation) :
                                    ",none,none,none,none"; // cells without moduli
            }
          text += '\n';
        }
      return text;
    }

    /** E/normal modulus and nu over the shear ratio: closed form as lines, relaxed as points with their scatter. */
    std::vector<postprocess::PlotPanel> panels_of(const std::vector<SweepPoint> &points, const double normal_modulus)
    {
      postprocess::PlotPanel young, poisson;
      young.title     = "Young's modulus";
      young.y_label   = "E / normal modulus of the links";
      poisson.title   = "Poisson's ratio";
      poisson.y_label = "nu";
      for (auto *panel : {&young, &poisson})
        {
          panel->x_label = "Shear ratio G/E of the links";
          panel->log_x   = true;
        }
      std::size_t colour = 0; // one for each interaction ratio
      for (std::size_t first = 0; first < points.size(); ++colour)
        {
          const double ratio = points[first].interaction_ratio;
          std::size_t  next  = first;
          while (next < points.size() && points[next].interaction_ratio == ratio)
            ++next;
          for (const HomogenisationWay &way : {homogenisation_ways[0], homogenisation_ways[2]})
            {
              postprocess::PlotSeries E, nu;
              E.name   = fmt::format("{} {}", way.name, ratio);
              E.style  = way.found == &HomogenisationAnswer::relaxed ? postprocess::PlotSeries::Style::points :
                                                                       postprocess::PlotSeries::Style::line;
              E.colour = postprocess::series_colour(colour);
              nu       = E;
              if (E.style == postprocess::PlotSeries::Style::line) // the closed form knows the shear ratio only
                {
                  nu.name   = "statistics, any interaction ratio";
                  nu.colour = "#000000";
                }
              for (std::size_t i = first; i < next; ++i)
                {
                  const auto e = points[i].figure(way.found, &dem::ElasticConstants::young);
                  const auto n = points[i].figure(way.found, &dem::ElasticConstants::poisson);
                  if (e.count == 0 || n.count == 0)
                    continue; // a cell without moduli
                  E.x.push_back(points[i].shear_ratio);
                  E.y.push_back(e.mean / normal_modulus);
                  nu.x.push_back(points[i].shear_ratio);
                  nu.y.push_back(n.mean);
                  if (E.style == postprocess::PlotSeries::Style::points)
                    {
                      E.y_error.push_back(e.deviation / normal_modulus);
                      nu.y_error.push_back(n.deviation);
                    }
                }
              if (E.x.empty())
                continue;
              young.series.push_back(E);
              if (nu.style == postprocess::PlotSeries::Style::points || first == 0)
                poisson.series.push_back(nu);
            }
          first = next;
        }
      return {young, poisson};
    }
  } // namespace

  RunResult run(const HomogenisationModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    const std::shared_ptr<dem::Ranks> team = launched_team();
    ShortRun                          run(request, "a homogenisation");
    const std::string                 origin = model.source == SpecimenSection::Source::file ? model.file : "generator";
    const std::vector<dem::Packing>   bodies = model.packings();
    std::vector<SweepPoint>           points;
    nlohmann::json                    json;
    json["made_by"] = "breccia " + version();
    json["cases"]   = nlohmann::json::array();
    for (const double iota : model.interaction_ratios)
      for (const double ratio : model.shear_ratios)
        {
          if (run.interrupted())
            return run.interrupted_result();
          HomogenisationQuestion requested = model.question(iota, ratio);
          requested.solver.ranks           = team.get();
          SweepPoint point{iota, ratio, {}};
          for (const dem::Packing &body : bodies)
            point.answers.push_back(homogenise(body, requested, origin));
          run.says(fmt::format("G/E = {:<8} {}{}\n", ratio, table_of(point.answers.front(), requested),
                               scatter_table(point.answers)));
          nlohmann::json entry = json_of(point.answers.front());
          if (point.answers.size() > 1)
            entry["scatter"] = scatter_json(point.answers);
          entry["interaction_ratio"] = iota;
          entry["shear_ratio"]       = ratio;
          json["cases"].push_back(entry);
          points.push_back(std::move(point));
        }

    json["figures"] = figures_of(points);
    return run.complete(std::move(json), [&](const std::filesystem::path &folder) {
      postprocess::write_text(folder / "homogenised.csv", csv_of(points));
      warn_of_missing("homogenised.png",
                      postprocess::plot(folder / "homogenised.png", panels_of(points, model.normal_modulus)));
    });
  }
} // namespace apps
