#include "apps/optimisation/direct_search.h"

#include "apps/optimisation/evaluated_residuals.h"
#include "base/errors.h"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>

namespace optimisation
{
  namespace
  {
    constexpr double without_answer = 10; // times the sum of squares of the start
    constexpr double first_step     = 3;  // in steps of the differences
    constexpr double last_step      = 0.1;

    /** The sum of squares as NLopt calls it: a failure to answer is no exception that would cross a library of C. */
    struct SumOfSquares
    {
      EvaluatedResiduals &evaluated;
      const int           most_evaluations;
      double              of_start;
      Eigen::VectorXd     best;
      double              least;
      nlopt_opt           search = nullptr;
      std::exception_ptr  thrown;

      double at(const Eigen::VectorXd &place)
      {
        const auto   residuals = evaluated.at(place);
        const double sum       = residuals ? residuals->squaredNorm() : without_answer * of_start;
        if (sum < least)
          {
            least = sum;
            best  = place;
          }
        if (evaluated.evaluations() >= most_evaluations)
          nlopt_force_stop(search);
        return sum;
      }

      static double call(const unsigned n, const double *place, double *, void *data)
      {
        auto &own = *static_cast<SumOfSquares *>(data);
        try
          {
            return own.at(Eigen::Map<const Eigen::VectorXd>(place, n));
          }
        catch (...)
          {
            own.thrown = std::current_exception();
            nlopt_force_stop(own.search);
            return own.least;
          }
      }
    };

    std::string ending_of(const nlopt_result result)
    {
      if (result == NLOPT_STOPVAL_REACHED)
        return "the sum of squares is as small as required";
      if (result == NLOPT_XTOL_REACHED || result == NLOPT_FTOL_REACHED || result == NLOPT_ROUNDOFF_LIMITED)
        return "its steps are smaller than a tenth of those of the differences";
      return "as many evaluations as it may take";
    }

    nlopt_result search_in(SumOfSquares &sum, const LeastSquaresProblem &problem, const LeastSquaresOptions &options)
    {
      const auto                                                   n = static_cast<unsigned>(problem.start.size());
      const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> own(nlopt_create(NLOPT_LN_SBPLX, n), nlopt_destroy);
      sum.search                        = own.get();
      const Eigen::VectorXd first_steps = first_step * problem.steps, last_steps = last_step * problem.steps;
      nlopt_set_min_objective(own.get(), SumOfSquares::call, &sum);
      nlopt_set_lower_bounds(own.get(), problem.lower.data());
      nlopt_set_upper_bounds(own.get(), problem.upper.data());
      nlopt_set_initial_step(own.get(), first_steps.data());
      nlopt_set_xtol_abs(own.get(), last_steps.data());
      if (options.smallest_sum > 0)
        nlopt_set_stopval(own.get(), options.smallest_sum);
      Eigen::VectorXd place = problem.start;
      double          least = 0;
      return nlopt_optimize(own.get(), place.data(), &least);
    }
  } // namespace

  LeastSquaresFit direct_search(const LeastSquaresProblem &problem, const LeastSquaresOptions &options)
  {
    refuse_unusable(problem);
    if (!problem.lower.allFinite() || !problem.upper.allFinite())
      throw base::InputError("search without derivatives: each variable needs two bounds.");
    EvaluatedResiduals evaluated(problem, options);
    const double       of_start = evaluated.at(problem.start)->squaredNorm();
    SumOfSquares       sum{evaluated, options.most_evaluations, of_start, problem.start, of_start, nullptr, nullptr};
    LeastSquaresFit    fit;
    if (of_start > options.smallest_sum)
      {
        const nlopt_result result = search_in(sum, problem, options);
        if (sum.thrown)
          std::rethrow_exception(sum.thrown);
        fit.converged = result != NLOPT_FORCED_STOP && result > 0;
        fit.ending    = ending_of(result);
      }
    else
      {
        fit.converged = true;
        fit.ending    = ending_of(NLOPT_STOPVAL_REACHED);
      }
    fit.place     = sum.best;
    fit.residuals = *evaluated.at(fit.place);
    if (const auto jacobian = options.jacobian_at_end ? evaluated.jacobian(fit.place) : std::nullopt)
      fit.jacobian = *jacobian;
    fit.evaluations = evaluated.evaluations();
    fit.failed      = evaluated.failed();
    return fit;
  }
} // namespace optimisation
