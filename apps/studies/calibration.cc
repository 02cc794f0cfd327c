#include "apps/studies/calibration.h"

#include "apps/statistics/distributions.h"
#include "apps/studies/calibration_doubts.h"
#include "apps/studies/sought_constants.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    constexpr double confidence = 0.95;

    bool scatter_is_known(const CalibrationFile &file) { return file.targets.front().deviation > 0; }

    /** Of those that are sought: numbers among these. */
    std::vector<int> on_bounds(const CalibrationFile &file, const SoughtConstants &problem)
    {
      std::vector<int> held;
      for (std::size_t k = 0; k < problem.kept().size(); ++k)
        {
          const SoughtConstant &constant = file.constants[problem.kept()[k]];
          const double          value    = problem.constants()[problem.kept()[k]];
          if (value <= constant.lower || value >= constant.upper)
            held.push_back(static_cast<int>(k));
        }
      return held;
    }

    /** Over the range of a constant: of differences that the noise of breaking specimens hardly touches. */
    double wide_step(const CalibrationFile &file) { return std::max(file.step, 0.06); }

    /** There are none where as many targets as constants have no standard deviations. */
    bool
    has_errors(const CalibrationFile &file, const SoughtConstants &problem, const optimisation::LeastSquaresFit &fit)
    {
      const auto held = static_cast<Eigen::Index>(on_bounds(file, problem).size());
      return scatter_is_known(file) || fit.residuals.size() > fit.place.size() - held;
    }

    /** Nothing where there are no errors, or no derivatives. */
    std::optional<statistics::Uncertainty> uncertainty_of(const CalibrationFile               &file,
                                                          const SoughtConstants               &problem,
                                                          const optimisation::LeastSquaresFit &fit,
                                                          const optimisation::ModelAtEnd      &end)
    {
      if (end.jacobian.size() == 0 || !has_errors(file, problem, fit))
        return std::nullopt;
      statistics::UncertaintyOptions options;
      options.held           = on_bounds(file, problem);
      options.known_scatter  = scatter_is_known(file) ? 1.0 : 0.0;
      options.model_noise    = end.noise;
      options.noise_degrees  = end.noise_degrees;
      options.noise_share    = end.share;
      options.jacobian_noise = end.of_column / (wide_step(file) * wide_step(file));
      return statistics::uncertainty(end.jacobian, end.residuals, problem.ranges()(problem.kept()), options);
    }

    /** Half of its band of 95 %, over its range: above one the bounds say as much as the targets do. */
    double relative_band(const CalibrationFile &file, const double value, const double half, const int constant)
    {
      const SoughtConstant &own = file.constants[constant];
      return half / std::max(value - own.lower, own.upper - value);
    }

    /** Among all: those without an error, but for those on a bound; otherwise that whose band most exceeds its bounds, if one does. */
    std::vector<int> undetermined_of(const CalibrationFile                        &file,
                                     const SoughtConstants                        &problem,
                                     const std::optional<statistics::Uncertainty> &sure)
    {
      std::vector<int>       fresh;
      const std::vector<int> held = on_bounds(file, problem);
      if (!sure)
        return fresh;
      for (const int k : sure->undetermined)
        if (std::find(held.begin(), held.end(), k) == held.end())
          fresh.push_back(problem.kept()[k]);
      if (!fresh.empty())
        return fresh;
      double widest = 1;
      for (std::size_t k = 0; k < problem.kept().size(); ++k)
        {
          const int    own = problem.kept()[k];
          const double width =
            relative_band(file, problem.constants()[own], sure->half_width(static_cast<int>(k), confidence), own);
          if (width >= widest) // false for one on its bound, which has none
            {
              widest = width;
              fresh  = {own};
            }
        }
      return fresh;
    }

    /** Among all: those that are not determined, where others are and can still be sought again. @param left sets that may be run */
    std::vector<int> to_hold(const CalibrationFile                        &file,
                             const SoughtConstants                        &problem,
                             const std::optional<statistics::Uncertainty> &sure,
                             const int                                     left)
    {
      std::vector<int> fresh  = undetermined_of(file, problem, sure);
      const int        others = static_cast<int>(problem.kept().size()) - static_cast<int>(fresh.size());
      if (others == 0 || left < others + 2) // the new start, derivatives and a step
        fresh.clear();
      return fresh;
    }

    /**
     * Among all: those of which the targets, by derivatives where all are now, would say less than the bounds do even if all others were
     * known. In a search noise would drive them from bound to bound. @param problem has these derivatives afterwards
     */
    std::vector<int> unseen(const CalibrationFile                   &file,
                            SoughtConstants                         &problem,
                            const optimisation::LeastSquaresOptions &options,
                            Calibration                             &found)
    {
      std::vector<int> all;
      const auto       here = problem.here();
      if (!here)
        return all;
      const auto end = problem.at_end(options, *here, {optimisation::NoiseSearch::never, {}});
      found.evaluations += end.evaluations;
      found.failed += end.failed;
      const double limit = statistics::half_normal_quantile(confidence);
      for (Eigen::Index k = 0; k < end.jacobian.cols(); ++k)
        if (const int own = problem.kept()[k];
            relative_band(file, problem.constants()[own], limit / end.jacobian.col(k).norm(), own) >= 1)
          all.push_back(own);
      return all.size() < problem.kept().size() ? all : std::vector<int>();
    }

    /** Where a search has ended. Where that shows what is not determined, no more is run for the noise: the others are sought again. */
    optimisation::ModelAtEnd end_of(const CalibrationFile                   &file,
                                    SoughtConstants                         &problem,
                                    const optimisation::LeastSquaresOptions &options,
                                    const optimisation::LeastSquaresFit     &fit,
                                    const int                                left)
    {
      optimisation::NoiseOptions noise;
      noise.search           = has_errors(file, problem, fit) ? file.model_noise : optimisation::NoiseSearch::never;
      noise.wide_steps       = wide_step(file) * problem.ranges()(problem.kept());
      noise.deviation        = scatter_is_known(file) ? 1.0 : 0.0;
      noise.most_evaluations = left;
      noise.goes_on          = [&](const optimisation::ModelAtEnd &so_far) {
        return to_hold(file, problem, uncertainty_of(file, problem, fit, so_far), left - so_far.evaluations).empty();
      };
      return problem.at_end(options, fit, noise);
    }

    /** What the last of several searches has come to. */
    struct Searches
    {
      std::vector<int>                       undetermined; ///< held for good
      optimisation::LeastSquaresFit          fit;
      optimisation::ModelAtEnd               end;
      std::optional<statistics::Uncertainty> sure;
    };

    /**
     * Until all that is still sought is determined.
     * @param screened whether what is not seen at the start is held until an answer shows it, for which sets must be left
     */
    Searches search(const CalibrationFile            &file,
                    SoughtConstants                  &problem,
                    optimisation::LeastSquaresOptions options,
                    const bool                        screened,
                    Calibration                      &found)
    {
      // Of all searches together.
      const auto left = [&] { return static_cast<int>(file.most_runs) - found.evaluations; };
      const auto hold = [&problem](std::vector<int> &held, const std::vector<int> &fresh) {
        held.insert(held.end(), fresh.begin(), fresh.end());
        problem.hold_at_start(fresh);
      };
      Searches         all;
      std::vector<int> for_later;
      if (screened)
        hold(for_later, unseen(file, problem, options, found));
      while (true)
        {
          options.most_evaluations = left();
          all.fit                  = problem.fit(options);
          found.evaluations += all.fit.evaluations;
          found.failed += all.fit.failed;
          if (!for_later.empty() && left() < static_cast<int>(file.constants.size()) + 2) // derivatives and a step
            {
              all.undetermined = for_later; // by the derivatives at the start
              for_later.clear();
            }
          if (!for_later.empty())
            {
              problem.seek_again(for_later);
              hold(all.undetermined, unseen(file, problem, options, found));
              const bool as_before = all.undetermined == for_later;
              for_later.clear();
              if (!as_before)
                continue;
            }
          all.end = end_of(file, problem, options, all.fit, left());
          found.evaluations += all.end.evaluations;
          found.failed += all.end.failed;
          all.sure                     = uncertainty_of(file, problem, all.fit, all.end);
          const std::vector<int> fresh = to_hold(file, problem, all.sure, left());
          if (fresh.empty())
            return all;
          hold(all.undetermined, fresh);
        }
    }

    void put_uncertainty(const CalibrationFile                        &file,
                         const SoughtConstants                        &problem,
                         const std::optional<statistics::Uncertainty> &sure,
                         const optimisation::ModelAtEnd               &end,
                         Calibration                                  &found)
    {
      if (!sure)
        {
          found.warnings.push_back("There are no standard errors: as many targets as constants, whose standard "
                                   "deviations are not known.");
          return;
        }
      found.condition = sure->condition;
      for (std::size_t k = 0; k < problem.kept().size(); ++k)
        {
          const int    own           = problem.kept()[k];
          const double half          = sure->half_width(static_cast<int>(k), confidence);
          found.standard_errors[own] = sure->standard_errors[k];
          found.determined[own]      = relative_band(file, found.constants[own], half, own) < 1; // false without one
          if (std::isnan(half))
            continue;
          found.lower[own] = std::max(found.constants[own] - half, file.constants[own].lower);
          found.upper[own] = std::min(found.constants[own] + half, file.constants[own].upper);
          for (std::size_t other = 0; other < problem.kept().size(); ++other)
            found.correlation(own, problem.kept()[other]) = sure->correlation(k, other);
        }
      for (Eigen::Index k = 0; k < end.residuals.size(); ++k)
        found.half_widths[k] = sure->half_width_of(end.jacobian.row(k).transpose(), confidence);
    }

    void warn(const CalibrationFile &file, const std::vector<int> &undetermined, Calibration &found)
    {
      for (const int k : undetermined)
        found.warnings.push_back(fmt::format("The targets do not determine {}: it is held at its start, {:g}.",
                                             file.constants[k].name, file.constants[k].start));
      for (std::size_t k = 0; k < file.constants.size(); ++k)
        if (found.constants[k] <= file.constants[k].lower || found.constants[k] >= file.constants[k].upper)
          found.warnings.push_back(file.constants[k].name +
                                   " lies on its bound: it has no error, and the others' hold for it there.");
        else if (!found.determined[k] && !std::isnan(found.standard_errors[k]))
          found.warnings.push_back("The targets say next to nothing of " + file.constants[k].name +
                                   ": its band of 95 % is as wide as its bounds, and Search/Most evaluations leaves no "
                                   "search of the others without it.");
      if (found.noisy)
        found.warnings.push_back(fmt::format(
          "Runs scatter between neighbouring constants by {:.2g} of what they are off the targets by chance: "
          "bars and bands contain that, and the answer is where {}.",
          found.noise,
          found.smoothed ? "many runs together have it" :
          found.astray   ? "the search ended: derivatives over wide steps lead to a worse one" :
                           "the search ended"));
      if (found.cut_short)
        found.warnings.push_back(
          "As many sets of constants were run as Search/Most evaluations says, and the answer is farther from where "
          "derivatives were taken than these hold: errors may be larger than their bars.");
      if (found.failed > 0)
        found.warnings.push_back(fmt::format("{} sets of constants had no answer.", found.failed));
    }

    /**
     * When fewer squares would not make the answer better. With known standard deviations, a sum of 0.01 is no farther from the smallest one
     * than a tenth of a standard error of any constant; with as many targets as constants a thousandth of each target is less than
     * specimens scatter by, and without an end the search would go on in their noise; otherwise the decrease says it.
     * @param targets sum of their squares
     */
    double usual_smallest_sum(const CalibrationFile &file, const CalibrationRuns &runs, const double targets)
    {
      constexpr double tenth_of_error = 0.01, thousandth_of_target = 1e-6;
      if (scatter_is_known(file))
        return tenth_of_error;
      return runs.measured().size() <= static_cast<Eigen::Index>(file.constants.size()) ?
               thousandth_of_target * targets :
               0.0;
    }

    optimisation::LeastSquaresOptions
    options_of(const CalibrationFile &file, const CalibrationRuns &runs, const double targets)
    {
      optimisation::LeastSquaresOptions options;
      options.central_differences = file.central_differences;
      options.jacobian_at_end     = false; // it is found where the roughness of the model is known
      options.updated_jacobian    = file.updated_jacobian;
      options.most_evaluations    = static_cast<int>(file.most_runs);
      options.smallest_decrease   = file.smallest_decrease;
      options.smallest_step       = 1.0 / 30; // a thousandth of the range with the usual steps
      options.smallest_sum =
        file.smallest_relative_sum > 0 ? file.smallest_relative_sum * targets : usual_smallest_sum(file, runs, targets);
      return options;
    }
  } // namespace

  Calibration calibrate(const CalibrationFile &file, CalibrationRuns &runs, CalibrationRuns *const cheap)
  {
    const double                            targets = runs.measured().cwiseQuotient(runs.scale()).squaredNorm();
    const optimisation::LeastSquaresOptions options = options_of(file, runs, targets);
    SoughtConstants                         problem(file, runs);
    Calibration                             found;
    if (cheap)
      {
        SoughtConstants before(file, *cheap);
        const auto      there   = before.fit(options);
        const auto      end     = before.at_end(options, there, {optimisation::NoiseSearch::never, {}});
        found.cheap_evaluations = there.evaluations + end.evaluations;
        problem.begin_at(before);
      }
    else if (const auto first = runs.predicted({problem.constants()}).front()) // the first set of the search
      found.at_start = *first;
    // A search begins with these derivatives, if it takes any that are known.
    const bool screened =
      !cheap && scatter_is_known(file) && file.updated_jacobian && file.method == SearchMethod::least_squares;
    const auto [undetermined, fit, end, sure] = search(file, problem, options, screened, found);
    constexpr double   nan                    = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Index n                      = problem.constants().size();
    found.constants                           = problem.constants();
    found.standard_errors = found.lower = found.upper = Eigen::VectorXd::Constant(n, nan);
    found.determined.assign(static_cast<std::size_t>(n), false);
    found.correlation  = Eigen::MatrixXd::Identity(n, n);
    found.predicted    = runs.measured() + end.residuals.cwiseProduct(runs.scale());
    found.half_widths  = Eigen::VectorXd::Constant(end.residuals.size(), nan);
    found.relative_sum = end.residuals.squaredNorm() / targets;
    found.noise        = end.largest_noise;
    found.noisy        = end.noise.cols() > 0;
    found.smoothed     = end.share < 1;
    found.astray       = end.leads_astray;
    found.cut_short    = end.cut_short;
    found.ending       = fit.ending;
    put_uncertainty(file, problem, sure, end, found);
    found.half_widths = found.half_widths.cwiseProduct(runs.scale());
    warn(file, undetermined, found);
    for (const std::string &doubt : doubts_of(file, runs))
      found.warnings.push_back(doubt);
    return found;
  }
} // namespace apps
