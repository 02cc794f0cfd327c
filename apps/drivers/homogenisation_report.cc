#include "apps/drivers/homogenisation_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numeric>

namespace apps
{
  namespace
  {
    struct Way
    {
      const char    *name, *meaning;
      FoundStiffness HomogenisationAnswer::*found;
    };

    const std::array<Way, 3> ways = {
      Way{"statistics", "closed form, no preferred direction", &HomogenisationAnswer::statistics},
      Way{"affine", "actual links, upper bound", &HomogenisationAnswer::affine},
      Way{"relaxed", "in equilibrium, the answer", &HomogenisationAnswer::relaxed}};

    nlohmann::json matrix(const dem::MacroscopicStiffness &D)
    {
      nlohmann::json rows = nlohmann::json::array();
      for (int i = 0; i < 6; ++i)
        {
          nlohmann::json row = nlohmann::json::array();
          for (int j = 0; j < 6; ++j)
            row.push_back(D(i, j));
          rows.push_back(row);
        }
      return rows;
    }

    std::vector<double>
    collect(const std::vector<HomogenisationAnswer> &answers, const Way &way, double dem::ElasticConstants::*figure)
    {
      std::vector<double> values;
      for (const HomogenisationAnswer &a : answers)
        values.push_back((a.*way.found).constants.*figure);
      return values;
    }
  } // namespace

  SampleFigure sample_figure(const std::vector<double> &values)
  {
    SampleFigure figure;
    const auto   n = static_cast<double>(values.size());
    figure.mean    = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double v : values)
      squares += (v - figure.mean) * (v - figure.mean);
    figure.deviation = values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0.0;
    return figure;
  }

  std::string table_of(const HomogenisationAnswer &answer, const HomogenisationQuestion &question)
  {
    std::string text =
      fmt::format("{} particles, {} links, interaction ratio {}, sum L A/3V = {:.6g}\n", answer.particles, answer.links,
                  question.links.interaction_ratio, answer.density.density());
    text += fmt::format("\n  {:<12} {:>12} {:>10} {:>12}\n", "", answer.dimension == 3 ? "E [GPa]" : "E2 [GPa]",
                        answer.dimension == 3 ? "nu" : "nu2", "over relaxed");
    for (const Way &way : ways)
      {
        const dem::ElasticConstants &c = (answer.*way.found).constants;
        text += fmt::format("  {:<12} {:>12.5f} {:>10.5f} {:>+11.2f}%  {}\n", way.name, 1e-9 * c.young, c.poisson,
                            100 * (c.young / answer.relaxed.constants.young - 1), way.meaning);
      }
    const dem::IsotropyMeasures &m = answer.isotropy;
    text +=
      fmt::format("\n  isotropy of the relaxed stiffness: E within {:.3g} %, nu within {:.3g}, G within {:.3g} %, "
                  "entries that should vanish {:.3g} % of E\n",
                  100 * m.young_spread, m.poisson_spread, 100 * m.shear_spread, 100 * m.off);
    text += "  solved " + answer.solver.text() + fmt::format(", {:.3g} s in all\n", answer.seconds);
    if (!answer.solver.mechanisms.empty())
      text += "  " + dem::describe(answer.solver.mechanisms) + " They carry no force.\n";
    return text;
  }

  std::string scatter_table(const std::vector<HomogenisationAnswer> &answers)
  {
    if (answers.size() < 2)
      return "";
    std::string text = fmt::format("\n  over {} packings, mean and standard deviation\n", answers.size());
    for (const Way &way : ways)
      {
        const SampleFigure E  = sample_figure(collect(answers, way, &dem::ElasticConstants::young));
        const SampleFigure nu = sample_figure(collect(answers, way, &dem::ElasticConstants::poisson));
        text += fmt::format("  {:<12} E = {:.5f} +- {:.5f} GPa   nu = {:.5f} +- {:.5f}\n", way.name, 1e-9 * E.mean,
                            1e-9 * E.deviation, nu.mean, nu.deviation);
      }
    return text;
  }

  nlohmann::json json_of(const HomogenisationAnswer &answer)
  {
    nlohmann::json json;
    for (const Way &way : ways)
      {
        const FoundStiffness &f = answer.*way.found;
        json[way.name] = {{"E", f.constants.young}, {"nu", f.constants.poisson}, {"stiffness", matrix(f.stiffness)}};
      }
    const dem::IsotropyMeasures &m = answer.isotropy;
    json["isotropy"]        = {{"E", m.young_spread}, {"nu", m.poisson_spread}, {"G", m.shear_spread}, {"off", m.off}};
    json["dimension"]       = answer.dimension;
    json["sum_LA_over_3V"]  = answer.density.density();
    json["particles"]       = answer.particles;
    json["links"]           = answer.links;
    const auto floaters     = dem::floaters(answer.solver.mechanisms);
    json["floaters"]        = floaters.size();
    json["floater_numbers"] = nlohmann::json::array();
    for (const std::int32_t i : floaters)
      json["floater_numbers"].push_back(i + 1);
    json["mechanisms"]   = dem::describe(answer.solver.mechanisms);
    json["solver"]       = answer.solver.method == dem::SolverMethod::direct ? "direct" : "iterative";
    json["iterations"]   = answer.solver.iterations;
    json["residual"]     = answer.solver.residual;
    json["wall_seconds"] = answer.seconds;
    return json;
  }

  nlohmann::json scatter_json(const std::vector<HomogenisationAnswer> &answers)
  {
    nlohmann::json json;
    json["packings"] = answers.size();
    for (const Way &way : ways)
      for (const auto &[name, figure] :
           {std::pair{"E", &dem::ElasticConstants::young}, std::pair{"nu", &dem::ElasticConstants::poisson}})
        {
          const std::vector<double> values = collect(answers, way, figure);
          const SampleFigure        sample = sample_figure(values);
          json[way.name][name] = {{"mean", sample.mean}, {"deviation", sample.deviation}, {"values", values}};
        }
    return json;
  }
} // namespace apps
