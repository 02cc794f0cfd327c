#include "apps/studies/analysis.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace apps
{
  namespace
  {
    constexpr double significant          = 0.05;
    constexpr double poorly_explained     = 0.9;
    constexpr int    most_runs_of_process = 300;

    void flag_copies(Analysis &analysis)
    {
      for (const auto &[copy, original] : analysis.table.copies)
        for (const auto &[run, other] : {std::pair(original, copy), std::pair(copy, original)})
          analysis.flags.push_back(
            {analysis.table.runs[run],
             fmt::format("equal to run {} in every column: a copy, not a replicate", analysis.table.runs[other])});
    }

    void flag_residuals(Analysis &analysis)
    {
      const statistics::LinearFit &fit = *analysis.fit();
      for (Eigen::Index run = 0; run < fit.studentised.size(); ++run)
        if (std::fabs(fit.studentised[run]) > suspicious_residual)
          analysis.flags.push_back(
            {analysis.table.runs[run],
             fmt::format("studentised residual {:.3g}, beyond {}: {:.6g} was found where all other runs predict {:.4g}",
                         fit.studentised[run], suspicious_residual, analysis.table.values[run], fit.left_out[run])});
    }

    std::string list_of(const std::vector<int> &counts) { return fmt::format("{}", fmt::join(counts, ", ")); }

    void judge_array(Analysis &analysis)
    {
      const statistics::ArrayCheck &array = analysis.array;
      if (array.worst_pair)
        analysis.warnings.push_back(fmt::format(
          "Levels of {} and {} do not occur together in proportion to their counts: main effects are not orthogonal.",
          analysis.table.factors[array.worst_pair->first].name, analysis.table.factors[array.worst_pair->second].name));
      else if (!array.balanced)
        {
          const auto uneven =
            std::find_if(array.levels.begin(), array.levels.end(), [](const statistics::Levels &levels) {
              return std::adjacent_find(levels.counts.begin(), levels.counts.end(), std::not_equal_to<>()) !=
                     levels.counts.end();
            });
          analysis.warnings.push_back(fmt::format(
            "Levels do not occur equally often ({} has them {} times), but all pairs in proportion to their counts: "
            "main effects are orthogonal, as in an array of which levels were collapsed, but not balanced.",
            analysis.table.factors[uneven - array.levels.begin()].name, list_of(uneven->counts)));
        }
      if (array.rank < array.wanted)
        analysis.warnings.push_back(
          fmt::format("The runs distinguish {} of {} main effects and mean.", array.rank, array.wanted));
    }

    void judge_null_column(Analysis &analysis)
    {
      for (const statistics::Effect &effect : analysis.anova->effects)
        if (effect.factor == analysis.options.null_column && effect.p < significant)
          analysis.warnings.push_back(fmt::format(
            "The null column {} is significant (F = {:.4g}, p = {:.2g}): interactions are aliased with it. Pooled into "
            "the error, it hides other effects.",
            effect.factor, effect.f, effect.p));
    }

    void judge_fit(Analysis &analysis)
    {
      const statistics::LinearFit &fit = *analysis.fit();
      if (fit.error_degrees == 0)
        analysis.warnings.push_back("No degree of freedom is left for the error: nothing can be said of significance.");
      else if (fit.r_squared() < poorly_explained)
        analysis.warnings.push_back(
          fmt::format("The model explains {:.1f} % of the scatter of {} only: terms are missing from it.",
                      100 * fit.r_squared(), analysis.table.response));
      if (analysis.surface && analysis.surface->lack_of_fit && analysis.surface->lack_of_fit->p < significant)
        analysis.warnings.push_back(fmt::format(
          "The surface misses more than runs at the same point differ (lack of fit F = {:.4g}, p = {:.2g}).",
          analysis.surface->lack_of_fit->f, analysis.surface->lack_of_fit->p));
    }

    /** The null column is taken out of the factors where it is pooled, and of surfaces. @return its name is among them */
    bool set_null_column(TableSelection &table, AnalysisOptions &options)
    {
      if (options.null_column.empty())
        return false;
      options.null_column = column_title(options.null_column).name;
      const auto null = std::find_if(table.factors.begin(), table.factors.end(), [&](const statistics::Factor &factor) {
        return factor.name == options.null_column;
      });
      if (null == table.factors.end())
        throw base::InputError("--null " + options.null_column + ": is none of the factors.");
      if (options.null_as == NullColumn::pooled)
        table.factors.erase(null);
      if (table.factors.empty())
        throw base::InputError("--null " + options.null_column + ": no factor is left beside it.");
      return options.null_as == NullColumn::error;
    }

    void fit_model(Analysis &analysis, const bool null_is_error)
    {
      const TableSelection &table = analysis.table;
      std::vector<int>      copies;
      for (const auto &copy : table.copies)
        copies.push_back(copy.first);
      switch (analysis.options.model)
        {
        case AnalysisModel::range:
          break;
        case AnalysisModel::anova:
          analysis.anova = statistics::analyse_variance(table.factors, table.values,
                                                        null_is_error ? analysis.options.null_column : "");
          break;
        case AnalysisModel::linear:
          analysis.surface = statistics::fit_surface(table.factors, table.values, statistics::Degree::linear, copies);
          break;
        case AnalysisModel::quadratic:
          analysis.surface =
            statistics::fit_surface(table.factors, table.values, statistics::Degree::quadratic, copies);
          break;
        }
      if (analysis.surface && analysis.options.gaussian_process && table.values.size() <= most_runs_of_process)
        analysis.process.emplace(table.factors, table.values);
    }
  } // namespace

  const statistics::LinearFit *Analysis::fit() const
  {
    if (anova)
      return &anova->fit;
    return surface ? &surface->fit : nullptr;
  }

  Analysis analyse(TableSelection table, const AnalysisOptions &options)
  {
    Analysis analysis;
    analysis.options         = options;
    const bool null_is_error = set_null_column(table, analysis.options);
    analysis.table           = std::move(table);
    const std::string where  = analysis.table.file.string() + ", " + analysis.table.response + ": ";
    try
      {
        analysis.array  = statistics::check_array(analysis.table.factors);
        analysis.ranges = statistics::ranges(analysis.table.factors, analysis.table.values);
        fit_model(analysis, null_is_error);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(where + refusal.what());
      }
    for (const std::string &run : analysis.table.left_out)
      analysis.warnings.push_back("Run " + run + " has no " + analysis.table.response + " and is left out.");
    flag_copies(analysis);
    if (!analysis.surface)
      judge_array(analysis);
    if (analysis.anova)
      judge_null_column(analysis);
    if (analysis.fit())
      {
        judge_fit(analysis);
        flag_residuals(analysis);
      }
    return analysis;
  }
} // namespace apps
