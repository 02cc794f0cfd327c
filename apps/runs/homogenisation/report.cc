#include "apps/runs/homogenisation/report.h"

#include "dem/homogenisation/resisted_strains.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  nlohmann::json json_of(const base::Stiffness &D)
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

  namespace
  {
    /** What a cell without moduli does resist, in one sentence; "" if it has them. */
    std::string shortcoming(const HomogenisationAnswer &answer)
    {
      const int all = dem::strains_of(answer.dimension), resisted = answer.relaxed.resisted;
      if (resisted == all)
        return "";
      return fmt::format("The cell has no {}: in equilibrium it resists {} of the {} independent strains, and has no "
                         "moduli. Raise the interaction ratio, or take a denser packing.",
                         resisted == 0 ? "stiffness" : "stiffness in some directions",
                         resisted == 0 ? "none" : std::to_string(resisted), all);
    }

    /** A row of the table: numbers, or that there are none. */
    std::string row_of(const HomogenisationAnswer &answer, const HomogenisationWay &way)
    {
      const std::optional<dem::ElasticConstants> &c       = (answer.*way.found).constants,
                                                 &relaxed = answer.relaxed.constants;
      if (!c)
        return fmt::format("  {:<12} {:>12} {:>10} {:>12}  {}\n", way.name, "none", "none", "", way.meaning);
      const std::string over = relaxed ? fmt::format("{:+.2f}%", 100 * (c->young / relaxed->young - 1)) : "";
      return fmt::format("  {:<12} {:>12.5f} {:>10.5f} {:>12}  {}\n", way.name, 1e-9 * c->young, c->poisson, over,
                         way.meaning);
    }

    /** Of those answers that have it. */
    std::vector<double> values_of(const std::vector<HomogenisationAnswer> &answers,
                                  FoundStiffness HomogenisationAnswer::*way,
                                  double dem::ElasticConstants::*figure)
    {
      std::vector<double> values;
      for (const HomogenisationAnswer &a : answers)
        if ((a.*way).constants)
          values.push_back(*(a.*way).constants.*figure);
      return values;
    }
  } // namespace

  statistics::SampleMoments moments_of(const std::vector<HomogenisationAnswer> &answers,
                                       FoundStiffness HomogenisationAnswer::*way,
                                       double dem::ElasticConstants::*figure)
  {
    return statistics::moments_of(values_of(answers, way, figure));
  }

  std::string table_of(const HomogenisationAnswer &answer, const HomogenisationQuestion &question)
  {
    std::string text =
      fmt::format("{} particles, {} links, interaction ratio {}, sum L A/3V = {:.6g}\n", answer.particles, answer.links,
                  question.links.interaction_ratio, answer.density.density());
    text += fmt::format("\n  {:<12} {:>12} {:>10} {:>12}\n", "", answer.dimension == 3 ? "E [GPa]" : "E2 [GPa]",
                        answer.dimension == 3 ? "nu" : "nu2", "over relaxed");
    for (const HomogenisationWay &way : homogenisation_ways)
      text += row_of(answer, way);
    if (const auto &m = answer.isotropy)
      text +=
        fmt::format("\n  isotropy of the relaxed stiffness: E within {:.3g} %, nu within {:.3g}, G within {:.3g} %, "
                    "entries that should vanish {:.3g} % of E\n",
                    100 * m->young_spread, m->poisson_spread, 100 * m->shear_spread, 100 * m->off);
    else
      text += "\n  " + shortcoming(answer) + "\n";
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
    for (const HomogenisationWay &way : homogenisation_ways)
      {
        const statistics::SampleMoments E  = moments_of(answers, way.found, &dem::ElasticConstants::young),
                                        nu = moments_of(answers, way.found, &dem::ElasticConstants::poisson);
        text += E.count > 0 ? fmt::format("  {:<12} E = {:.5f} +- {:.5f} GPa   nu = {:.5f} +- {:.5f}", way.name,
                                          1e-9 * E.mean, 1e-9 * E.deviation, nu.mean, nu.deviation) :
                              fmt::format("  {:<12} none", way.name);
        if (E.count < answers.size())
          text += fmt::format("   {} of them without moduli", answers.size() - E.count);
        text += '\n';
      }
    return text;
  }

  nlohmann::json json_of(const HomogenisationAnswer &answer)
  {
    nlohmann::json json;
    for (const HomogenisationWay &way : homogenisation_ways)
      {
        const FoundStiffness &f = answer.*way.found;
        json[way.name]          = {{"E", nullptr}, {"nu", nullptr}, {"stiffness", json_of(f.stiffness)}};
        if (f.constants)
          json[way.name].update({{"E", f.constants->young}, {"nu", f.constants->poisson}});
        json[way.name]["resisted_strains"] = f.resisted;
      }
    json["isotropy"] = nullptr;
    if (const auto &m = answer.isotropy)
      json["isotropy"] = {{"E", m->young_spread}, {"nu", m->poisson_spread}, {"G", m->shear_spread}, {"off", m->off}};
    json["without_moduli"]  = shortcoming(answer);
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
    for (const HomogenisationWay &way : homogenisation_ways)
      for (const auto &[name, figure] :
           {std::pair{"E", &dem::ElasticConstants::young}, std::pair{"nu", &dem::ElasticConstants::poisson}})
        {
          const std::vector<double> values = values_of(answers, way.found, figure);
          json[way.name][name]             = {{"mean", nullptr}, {"deviation", nullptr}, {"values", values}};
          if (const statistics::SampleMoments sample = statistics::moments_of(values); sample.count > 0)
            json[way.name][name].update({{"mean", sample.mean}, {"deviation", sample.deviation}});
        }
    return json;
  }
} // namespace apps
