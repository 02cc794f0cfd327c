#include "apps/statistics/distributions.h"
#include "apps/studies/analysis_files.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    std::string with_unit(const std::string &name, const std::string &unit)
    {
      return unit.empty() ? name : name + " [" + unit + "]";
    }

    std::string range_words(const Analysis &analysis)
    {
      std::string text = fmt::format("{:<14} {:>5} {:>12}   means at rising levels\n", "factor", "rank", "range");
      for (const statistics::FactorRange &range : analysis.ranges)
        {
          text += fmt::format("{:<14} {:>5} {:>12.6g}  ", range.factor, range.rank, range.range);
          for (const double mean : range.means)
            text += fmt::format(" {:>10.6g}", mean);
          text += '\n';
        }
      return text;
    }

    std::string anova_words(const statistics::Anova &anova)
    {
      std::string text =
        fmt::format("{:<14} {:>14} {:>8} {:>10} {:>10}\n", "factor", "sum of squares", "degrees", "F", "p");
      for (const statistics::Effect &effect : anova.effects)
        text += fmt::format("{:<14} {:>14.6g} {:>8} {:>10.5g} {:>10.2g}\n", effect.factor, effect.sum_of_squares,
                            effect.degrees, effect.f, effect.p);
      text += fmt::format("{:<14} {:>14.6g} {:>8}\n", "error", anova.error_sum, anova.error_degrees);
      return text + fmt::format("{:<14} {:>14.6g} {:>8}\n", "total", anova.total_sum, anova.fit.residuals.size() - 1);
    }

    double significance(const statistics::ResponseSurface &surface, const std::size_t term)
    {
      return statistics::t_probability_beyond(surface.coefficients[term] / surface.standard_errors[term],
                                              surface.fit.error_degrees);
    }

    std::string surface_words(const statistics::ResponseSurface &surface)
    {
      const std::vector<std::string> names = surface.polynomial.term_names();
      std::string                    text =
        fmt::format("{:<18} {:>14} {:>14} {:>10} {:>14}\n", "term", "coefficient", "standard error", "p", "coded");
      for (std::size_t term = 0; term < names.size(); ++term)
        text += fmt::format("{:<18} {:>14.7g} {:>14.3g} {:>10.2g} {:>14.6g}\n", names[term], surface.coefficients[term],
                            surface.standard_errors[term], significance(surface, term), surface.coded[term]);
      return text;
    }

    std::string fit_words(const Analysis &analysis)
    {
      const statistics::LinearFit &fit = *analysis.fit();
      std::string text = fmt::format("\nR^2 {:.6f}, adjusted {:.6f}, leave-one-out {:.6f}; standard error {:.4g} {}\n",
                                     fit.r_squared(), fit.adjusted_r_squared(), fit.press_r_squared(),
                                     fit.standard_error(), analysis.table.response_unit);
      if (analysis.surface && analysis.surface->lack_of_fit)
        {
          const statistics::LackOfFit &lack = *analysis.surface->lack_of_fit;
          text += fmt::format("lack of fit F({}, {}) = {:.4g}, p = {:.2g}\n", lack.lack_degrees, lack.pure_degrees,
                              lack.f, lack.p);
        }
      if (analysis.process)
        text += fmt::format("Gaussian process: leave-one-out {:.6f}\n",
                            1 - (analysis.table.values - analysis.process->left_out()).squaredNorm() / fit.total_sum);
      return text;
    }
  } // namespace

  std::string words_of(const Analysis &analysis)
  {
    std::string text = fmt::format("{}: {} over {} factors in {} runs\n\n", analysis.table.file.string(),
                                   with_unit(analysis.table.response, analysis.table.response_unit),
                                   analysis.table.factors.size(), analysis.table.values.size());
    if (analysis.surface)
      text += surface_words(*analysis.surface);
    else
      text += range_words(analysis);
    if (analysis.anova)
      text += "\n" + anova_words(*analysis.anova);
    if (analysis.fit())
      text += fit_words(analysis);
    for (const std::string &warning : analysis.warnings)
      text += "warning: " + warning + "\n";
    for (const FlaggedRun &flag : analysis.flags)
      text += "run " + flag.run + ": " + flag.reason + "\n";
    return text;
  }

  std::string csv_of(const Analysis &analysis)
  {
    std::string text;
    if (analysis.surface)
      {
        const statistics::ResponseSurface &surface = *analysis.surface;
        const std::vector<std::string>     names   = surface.polynomial.term_names();
        text                                       = "term,coefficient,standard_error,p,coded,coded_standard_error\n";
        for (std::size_t term = 0; term < names.size(); ++term)
          text +=
            fmt::format("{},{},{},{},{},{}\n", names[term], surface.coefficients[term], surface.standard_errors[term],
                        significance(surface, term), surface.coded[term], surface.coded_standard_errors[term]);
      }
    else if (analysis.anova)
      {
        text = "factor,sum_of_squares,degrees,F,p\n";
        for (const statistics::Effect &effect : analysis.anova->effects)
          text +=
            fmt::format("{},{},{},{},{}\n", effect.factor, effect.sum_of_squares, effect.degrees, effect.f, effect.p);
      }
    else
      {
        text = "factor,rank,range,level,mean\n";
        for (const statistics::FactorRange &range : analysis.ranges)
          for (std::size_t level = 0; level < range.levels.size(); ++level)
            text += fmt::format("{},{},{},{},{}\n", range.factor, range.rank, range.range, range.levels[level],
                                range.means[level]);
      }
    return text;
  }

  std::string residuals_csv_of(const Analysis &analysis)
  {
    const statistics::LinearFit *fit = analysis.fit();
    if (!fit)
      return "";
    std::string text = "run,observed,predicted,residual,leverage,left_out_prediction,studentised\n";
    for (Eigen::Index run = 0; run < fit->residuals.size(); ++run)
      text +=
        fmt::format("{},{},{},{},{},{},{}\n", analysis.table.runs[run], analysis.table.values[run], fit->fitted[run],
                    fit->residuals[run], fit->leverage[run], fit->left_out[run], fit->studentised[run]);
    return text;
  }
} // namespace apps
