#include "apps/process/version.h"
#include "apps/studies/analysis_files.h"
#include "postprocess/files/numeric_text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace apps
{
  namespace
  {
    using nlohmann::json;

    const char *name_of(const AnalysisModel model)
    {
      switch (model)
        {
        case AnalysisModel::range:
          return "range";
        case AnalysisModel::anova:
          return "anova";
        case AnalysisModel::linear:
          return "linear";
        default:
          return "quadratic";
        }
    }

    /** A number where the table has a whole one. */
    json run_json(const std::string &run)
    {
      const auto number = postprocess::numeric_text::number(run);
      return number && *number == std::floor(*number) && std::fabs(*number) < 1e15 ? json(static_cast<long>(*number)) :
                                                                                     json(run);
    }

    json array_json(const Analysis &analysis)
    {
      const statistics::ArrayCheck &array = analysis.array;
      json                          found = {{"balanced", array.balanced}, {"proportional", array.proportional},
                                             {"rank", array.rank},         {"rank_wanted", array.wanted},
                                             {"levels", json::object()},   {"repeated_points", json::array()}};
      for (std::size_t factor = 0; factor < array.levels.size(); ++factor)
        found["levels"][analysis.table.factors[factor].name] = {{"values", array.levels[factor].values},
                                                                {"counts", array.levels[factor].counts}};
      if (array.worst_pair)
        found["worst_pair"] = {analysis.table.factors[array.worst_pair->first].name,
                               analysis.table.factors[array.worst_pair->second].name};
      for (const auto &[run, first] : array.duplicates)
        found["repeated_points"].push_back(
          {{"run", run_json(analysis.table.runs[run])}, {"repeats", run_json(analysis.table.runs[first])}});
      return found;
    }

    json surface_json(const statistics::ResponseSurface &surface)
    {
      const std::vector<std::string> names = surface.polynomial.term_names();
      json                           found;
      for (std::size_t term = 0; term < names.size(); ++term)
        {
          found["terms"][names[term]]                 = surface.coefficients[term];
          found["standard_errors"][names[term]]       = surface.standard_errors[term];
          found["coded_terms"][names[term]]           = surface.coded[term];
          found["coded_standard_errors"][names[term]] = surface.coded_standard_errors[term];
        }
      for (std::size_t factor = 0; factor < surface.polynomial.factors().size(); ++factor)
        found["box"][surface.polynomial.factors()[factor]] = {surface.box.lower[factor], surface.box.upper[factor]};
      return found;
    }

    void put_fit(json &found, const Analysis &analysis)
    {
      const statistics::LinearFit &fit = *analysis.fit();
      found["r_squared"]               = fit.r_squared();
      found["adjusted_r_squared"]      = fit.adjusted_r_squared();
      found["press_r_squared"]         = fit.press_r_squared();
      found["press"]                   = fit.press;
      found["standard_error"]          = fit.standard_error();
      found["residuals"]               = json::array();
      for (Eigen::Index run = 0; run < fit.residuals.size(); ++run)
        found["residuals"].push_back({{"run", run_json(analysis.table.runs[run])},
                                      {"observed", analysis.table.values[run]},
                                      {"predicted", fit.fitted[run]},
                                      {"residual", fit.residuals[run]},
                                      {"leverage", fit.leverage[run]},
                                      {"left_out_prediction", fit.left_out[run]},
                                      {"studentised", fit.studentised[run]}});
    }

    void put_anova(json &found, const statistics::Anova &anova)
    {
      for (const statistics::Effect &effect : anova.effects)
        found["anova"][effect.factor] = {
          {"sum_of_squares", effect.sum_of_squares}, {"degrees", effect.degrees}, {"F", effect.f}, {"p", effect.p}};
      found["anova_error"] = {{"sum_of_squares", anova.error_sum}, {"degrees", anova.error_degrees}};
      found["anova_total"] = {{"sum_of_squares", anova.total_sum}, {"degrees", anova.fit.residuals.size() - 1}};
    }

    json process_json(const Analysis &analysis)
    {
      const statistics::GaussianProcess &process = *analysis.process;
      json                               found   = {{"mean", process.mean()},
                                                    {"process_variance", process.process_variance()},
                                                    {"scatter", process.shape().scatter},
                                                    {"log_likelihood", process.log_likelihood()}};
      for (std::size_t factor = 0; factor < analysis.table.factors.size(); ++factor)
        found["coded_lengths"][analysis.table.factors[factor].name] = process.shape().lengths[factor];
      found["left_out_r_squared"] =
        1 - (analysis.table.values - process.left_out()).squaredNorm() / analysis.surface->fit.total_sum;
      return found;
    }
  } // namespace

  json json_of(const Analysis &analysis)
  {
    json found = {{"made_by", "breccia " + version()},
                  {"table", analysis.table.file.string()},
                  {"response", {{"name", analysis.table.response}, {"unit", analysis.table.response_unit}}},
                  {"model", name_of(analysis.options.model)},
                  {"runs", analysis.table.values.size()},
                  {"array", array_json(analysis)},
                  {"ranges", json::object()},
                  {"flags", json::array()},
                  {"warnings", analysis.warnings}};
    for (const statistics::FactorRange &range : analysis.ranges)
      found["ranges"][range.factor] = {
        {"levels", range.levels}, {"means", range.means}, {"range", range.range}, {"rank", range.rank}};
    for (const FlaggedRun &flag : analysis.flags)
      found["flags"].push_back({{"run", run_json(flag.run)}, {"reason", flag.reason}});
    if (analysis.fit())
      put_fit(found, analysis);
    if (analysis.anova)
      put_anova(found, *analysis.anova);
    if (analysis.surface)
      found["surface"] = surface_json(*analysis.surface);
    if (analysis.surface && analysis.surface->lack_of_fit)
      {
        const statistics::LackOfFit &lack = *analysis.surface->lack_of_fit;
        found["lack_of_fit"]              = {{"F", lack.f},
                                             {"p", lack.p},
                                             {"pure_error_sum_of_squares", lack.pure_error},
                                             {"pure_error_degrees", lack.pure_degrees},
                                             {"sum_of_squares", lack.lack},
                                             {"degrees", lack.lack_degrees}};
      }
    if (analysis.process)
      found["gaussian_process"] = process_json(analysis);
    return found;
  }
} // namespace apps
