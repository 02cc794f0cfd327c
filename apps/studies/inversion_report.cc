#include "apps/studies/inversion_report.h"

#include "apps/process/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace apps
{
  namespace
  {
    double deviation(const InversionQuestion &question, const InversionSolution &solution, const std::size_t response)
    {
      return solution.responses[response] / question.targets[response] - 1;
    }
  } // namespace

  std::string words_of(const InversionQuestion &question, const Inversion &found)
  {
    std::string text = fmt::format("{:<14} {:>12} {:>12} {:>12}\n", "response", "target", "surface", "deviation");
    for (std::size_t k = 0; k < question.targets.size(); ++k)
      text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>10.3g} %\n", question.surfaces[k].response,
                          question.targets[k], found.best().responses[k], 100 * deviation(question, found.best(), k));
    text += fmt::format("\n{:<14} {:>12} {:>12} {:>12}   of {} equally good answers\n", "constant", "most central",
                        "least", "largest", found.equally_good.size());
    for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
      {
        double least = INFINITY, largest = -INFINITY;
        for (const InversionSolution &solution : found.equally_good)
          {
            least   = std::min(least, solution.constants[factor]);
            largest = std::max(largest, solution.constants[factor]);
          }
        text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>12.6g}\n", found.factors[factor],
                            found.best().constants[factor], least, largest);
      }
    for (const std::string &warning : found.warnings)
      text += "warning: " + warning + "\n";
    return text;
  }

  nlohmann::json json_of(const InversionQuestion &question, const Inversion &found)
  {
    nlohmann::json json = {{"made_by", "breccia " + version()}, {"seed", question.genetic.seed},
                           {"reached", found.reached},          {"misfit", found.best().misfit},
                           {"warnings", found.warnings},        {"solutions", nlohmann::json::array()}};
    for (const InversionSolution &solution : found.equally_good)
      {
        nlohmann::json one = {{"misfit", solution.misfit}};
        for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
          one["constants"][found.factors[factor]] = solution.constants[factor];
        json["solutions"].push_back(one);
      }
    for (std::size_t k = 0; k < question.targets.size(); ++k)
      json["responses"][question.surfaces[k].response] = {{"target", question.targets[k]},
                                                          {"value", found.best().responses[k]},
                                                          {"relative_deviation", deviation(question, found.best(), k)},
                                                          {"unit", question.surfaces[k].unit}};
    for (std::size_t factor = 0; factor < found.factors.size(); ++factor)
      {
        Eigen::VectorXd values(static_cast<Eigen::Index>(found.equally_good.size()));
        for (std::size_t k = 0; k < found.equally_good.size(); ++k)
          values[k] = found.equally_good[k].constants[factor];
        json["constants"][found.factors[factor]] = {{"value", found.best().constants[factor]},
                                                    {"least", values.minCoeff()},
                                                    {"largest", values.maxCoeff()},
                                                    {"box", {found.box.lower[factor], found.box.upper[factor]}}};
      }
    return json;
  }

  std::string words_of(const InversionQuestion &question, const ScaledRound &round)
  {
    std::string text = fmt::format("\n{:<14} {:>12} {:>12} {:>12} {:>12} {:>12}   of {} runs\n", "response", "target",
                                   "requested", "mean", "deviation", "variation", round.runs);
    for (std::size_t k = 0; k < question.targets.size(); ++k)
      text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>12.6g} {:>10.3g} % {:>10.3g} %\n",
                          question.surfaces[k].response, question.targets[k], round.requested[k], round.means[k],
                          100 * (round.means[k] / question.targets[k] - 1), 100 * round.variations[k]);
    return text;
  }

  nlohmann::json json_of(const InversionQuestion &question, const ScaledTargets &scaled)
  {
    nlohmann::json rounds = nlohmann::json::array();
    for (const ScaledRound &round : scaled.rounds)
      {
        nlohmann::json &own = rounds.emplace_back(nlohmann::json{{"runs", round.runs}});
        for (std::size_t k = 0; k < question.targets.size(); ++k)
          own["responses"][question.surfaces[k].response] = {{"requested", round.requested[k]},
                                                             {"mean", round.means[k]},
                                                             {"coefficient_of_variation", round.variations[k]}};
        for (std::size_t factor = 0; factor < round.found.factors.size(); ++factor)
          own["constants"][round.found.factors[factor]] = round.found.best().constants[factor];
      }
    return {{"within_tolerance", scaled.within_tolerance}, {"rounds", rounds}};
  }
} // namespace apps
