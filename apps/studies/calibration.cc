#include "apps/studies/calibration.h"

#include "apps/optimisation/direct_search.h"
#include "apps/studies/calibration_doubts.h"
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

    /** The constants that are sought, among all: the others are held. */
    class SoughtAmongAll
    {
    public:
      SoughtAmongAll(const CalibrationFile &file_, CalibrationRuns &runs_)
        : file(file_)
        , runs(runs_)
        , all(file.constants.size())
      {
        for (std::size_t k = 0; k < file.constants.size(); ++k)
          {
            all[k] = file.constants[k].start;
            sought.push_back(static_cast<int>(k));
          }
      }

      const std::vector<int> &kept() const { return sought; }
      const Eigen::VectorXd  &constants() const { return all; }
      Eigen::VectorXd         ranges() const
      {
        Eigen::VectorXd values(all.size());
        for (Eigen::Index k = 0; k < all.size(); ++k)
          values[k] = file.constants[k].upper - file.constants[k].lower;
        return values;
      }

      void hold_at_start(const std::vector<int> &held)
      {
        const std::vector<int> before = sought;
        std::vector<int>       columns;
        sought.clear();
        for (std::size_t k = 0; k < before.size(); ++k)
          if (std::find(held.begin(), held.end(), before[k]) == held.end())
            {
              sought.push_back(before[k]);
              columns.push_back(static_cast<int>(k));
            }
          else
            all[before[k]] = file.constants[before[k]].start;
        if (known_jacobian.size() > 0)
          known_jacobian = Eigen::MatrixXd(known_jacobian(Eigen::all, columns));
      }

      /** Where another model has its answer, with its derivatives. */
      void begin_at(const SoughtAmongAll &other)
      {
        all            = other.all;
        known_jacobian = other.known_jacobian;
      }

      optimisation::LeastSquaresFit fit(const optimisation::LeastSquaresOptions &options)
      {
        optimisation::LeastSquaresProblem problem;
        const auto                        n = static_cast<Eigen::Index>(sought.size());
        problem.start                       = all(sought);
        problem.lower                       = Eigen::VectorXd(n);
        problem.upper                       = Eigen::VectorXd(n);
        problem.steps                       = file.step * ranges()(sought);
        for (Eigen::Index k = 0; k < n; ++k)
          {
            problem.lower[k] = file.constants[sought[k]].lower;
            problem.upper[k] = file.constants[sought[k]].upper;
          }
        problem.residuals = [this](const std::vector<Eigen::VectorXd> &places) {
          std::vector<Eigen::VectorXd> sets;
          for (const Eigen::VectorXd &place : places)
            {
              sets.push_back(all);
              sets.back()(sought) = place;
            }
          auto values = runs.predicted(sets);
          for (auto &own : values)
            if (own)
              own = (*own - runs.measured()).cwiseQuotient(runs.scale());
          return values;
        };
        problem.first_jacobian              = known_jacobian;
        optimisation::LeastSquaresFit found = file.method == SearchMethod::least_squares ?
                                                optimisation::least_squares(problem, options) :
                                                optimisation::direct_search(problem, options);
        all(sought)                         = found.place;
        known_jacobian                      = found.jacobian;
        return found;
      }

      /**
       * What runs around the answer are off straight lines by, a constant each: r(x + h) - 2 r(x) + r(x - h) has six times the variance of the
       * noise of one run. Constants too near a bound have none.
       */
      Eigen::MatrixXd noise(const optimisation::LeastSquaresFit &fit)
      {
        const Eigen::VectorXd        steps = file.step * ranges();
        std::vector<Eigen::VectorXd> sets;
        for (const int k : sought)
          if (all[k] - steps[k] >= file.constants[k].lower && all[k] + steps[k] <= file.constants[k].upper)
            for (const double way : {1.0, -1.0})
              {
                sets.push_back(all);
                sets.back()[k] += way * steps[k];
              }
        const auto      values = runs.predicted(sets);
        Eigen::MatrixXd found(fit.residuals.size(), 0);
        for (std::size_t pair = 0; pair + 1 < values.size(); pair += 2)
          if (values[pair] && values[pair + 1])
            {
              found.conservativeResize(Eigen::NoChange, found.cols() + 1);
              found.rightCols(1) =
                ((*values[pair] + *values[pair + 1] - 2 * runs.measured()).cwiseQuotient(runs.scale()) -
                 2 * fit.residuals) /
                std::sqrt(6.0);
            }
        return found;
      }

    private:
      const CalibrationFile &file;
      CalibrationRuns       &runs;
      Eigen::VectorXd        all;
      std::vector<int>       sought;
      Eigen::MatrixXd        known_jacobian; ///< where the last search ended; empty: there was none
    };

    bool scatter_is_known(const CalibrationFile &file) { return file.targets.front().deviation > 0; }

    /** Of those that are sought: numbers among these. */
    std::vector<int> on_bounds(const CalibrationFile &file, const SoughtAmongAll &problem)
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

    /** Nothing where there are as many targets as constants. */
    std::optional<statistics::Uncertainty>
    uncertainty_of(const CalibrationFile &file, SoughtAmongAll &problem, const optimisation::LeastSquaresFit &fit)
    {
      const std::vector<int> held = on_bounds(file, problem);
      const Eigen::Index     free = fit.place.size() - static_cast<Eigen::Index>(held.size());
      if (fit.jacobian.size() == 0 || (!scatter_is_known(file) && fit.residuals.size() <= free))
        return std::nullopt;
      statistics::UncertaintyOptions options;
      options.held          = held;
      options.known_scatter = scatter_is_known(file) ? 1.0 : 0.0;
      if (file.model_noise)
        options.model_noise = problem.noise(fit);
      return statistics::uncertainty(fit.jacobian, fit.residuals, problem.ranges()(problem.kept()), options);
    }

    /** Half of its band of 95 %, over its range: above one the bounds say as much as the targets do. */
    double relative_band(const CalibrationFile &file, const double value, const double half, const int constant)
    {
      const SoughtConstant &own = file.constants[constant];
      return half / std::max(value - own.lower, own.upper - value);
    }

    /** Among all: those without an error, but for those on a bound; otherwise that whose band most exceeds its bounds, if one does. */
    std::vector<int> undetermined_of(const CalibrationFile                        &file,
                                     const SoughtAmongAll                         &problem,
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

    void put_uncertainty(const CalibrationFile                        &file,
                         const SoughtAmongAll                         &problem,
                         const std::optional<statistics::Uncertainty> &sure,
                         const optimisation::LeastSquaresFit          &fit,
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
      for (Eigen::Index k = 0; k < fit.residuals.size(); ++k)
        found.half_widths[k] = sure->half_width_of(fit.jacobian.row(k).transpose(), confidence);
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
                                   ": its band of 95 % is as wide as its bounds.");
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
    SoughtAmongAll                          problem(file, runs);
    Calibration                             found;
    if (cheap)
      {
        SoughtAmongAll before(file, *cheap);
        found.cheap_evaluations = before.fit(options).evaluations;
        problem.begin_at(before);
      }
    std::vector<int>                       undetermined;
    optimisation::LeastSquaresFit          fit;
    std::optional<statistics::Uncertainty> sure;
    while (true)
      {
        fit = problem.fit(options);
        found.evaluations += fit.evaluations;
        found.failed += fit.failed;
        sure                         = uncertainty_of(file, problem, fit);
        const std::vector<int> fresh = undetermined_of(file, problem, sure);
        if (fresh.empty() || fresh.size() == problem.kept().size())
          break;
        undetermined.insert(undetermined.end(), fresh.begin(), fresh.end());
        problem.hold_at_start(fresh);
      }
    constexpr double   nan = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Index n   = problem.constants().size();
    found.constants        = problem.constants();
    found.standard_errors = found.lower = found.upper = Eigen::VectorXd::Constant(n, nan);
    found.determined.assign(static_cast<std::size_t>(n), false);
    found.correlation  = Eigen::MatrixXd::Identity(n, n);
    found.predicted    = runs.measured() + fit.residuals.cwiseProduct(runs.scale());
    found.half_widths  = Eigen::VectorXd::Constant(fit.residuals.size(), nan);
    found.relative_sum = fit.sum_of_squares() / targets;
    found.ending       = fit.ending;
    put_uncertainty(file, problem, sure, fit, found);
    found.half_widths = found.half_widths.cwiseProduct(runs.scale());
    warn(file, undetermined, found);
    for (const std::string &doubt : doubts_of(file, runs))
      found.warnings.push_back(doubt);
    return found;
  }
} // namespace apps
