#include "apps/optimisation/least_squares_search.h"

#include "apps/optimisation/evaluated_residuals.h"
#include "base/errors.h"

#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cmath>

namespace optimisation
{
  namespace
  {
    constexpr int most_iterations = 500, most_failures_in_a_row = 20, most_rounds = 100;

    using Place = Eigen::Map<const Eigen::VectorXd>;

    /** What Ceres sees of the problem: ways from an origin in units of the steps. */
    class Cost : public ceres::CostFunction
    {
    public:
      Cost(EvaluatedResiduals &evaluated_, const Eigen::VectorXd &origin_, const Eigen::VectorXd &scale_)
        : evaluated(evaluated_)
        , origin(origin_)
        , scale(scale_)
      {
        set_num_residuals(static_cast<int>(evaluated.count()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(scale.size()));
      }

      Eigen::VectorXd place(const double *ways) const
      {
        return evaluated.within_bounds(origin + Place(ways, scale.size()).cwiseProduct(scale));
      }

      bool Evaluate(double const *const *parameters, double *residuals, double **jacobians) const override
      {
        const Eigen::VectorXd here  = place(parameters[0]);
        const auto            found = evaluated.at(here);
        if (!found)
          return false;
        Eigen::Map<Eigen::VectorXd>(residuals, found->size()) = *found;
        if (!jacobians || !jacobians[0])
          return true;
        const auto slope = evaluated.jacobian(here);
        if (!slope)
          return false;
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        Eigen::Map<RowMajor>(jacobians[0], slope->rows(), slope->cols()) = *slope * scale.asDiagonal();
        return true;
      }

    private:
      EvaluatedResiduals   &evaluated;
      const Eigen::VectorXd origin, scale;
    };

    /** Ends the search once no evaluation is left, or the sum is small enough. */
    class Watch : public ceres::IterationCallback
    {
    public:
      Watch(const EvaluatedResiduals &evaluated_, const LeastSquaresOptions &options_)
        : evaluated(evaluated_)
        , options(options_)
      {
      }
      ceres::CallbackReturnType operator()(const ceres::IterationSummary &summary) override
      {
        if (2 * summary.cost <= options.smallest_sum)
          return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
        if (summary.iteration > 0 &&
            summary.step_norm < options.smallest_step) // in units of the steps of the differences
          return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
        if (!summary.step_is_successful && evaluated.updated()) // differences are cheaper than ever shorter steps
          return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
        return evaluated.evaluations() >= options.most_evaluations ? ceres::SOLVER_TERMINATE_SUCCESSFULLY :
                                                                     ceres::SOLVER_CONTINUE;
      }

    private:
      const EvaluatedResiduals  &evaluated;
      const LeastSquaresOptions &options;
    };

    ceres::Solver::Options solver_options(const LeastSquaresOptions &options, ceres::IterationCallback *watch)
    {
      ceres::Solver::Options solver;
      solver.linear_solver_type                = ceres::DENSE_QR; // by Eigen: no call to any BLAS
      solver.num_threads                       = 1;
      solver.logging_type                      = ceres::SILENT;
      solver.max_num_iterations                = most_iterations;
      solver.max_num_consecutive_invalid_steps = most_failures_in_a_row;
      solver.function_tolerance                = options.smallest_decrease;
      solver.gradient_tolerance                = 1e-30;
      solver.parameter_tolerance               = 1e-15;
      solver.initial_trust_region_radius       = 1e4;
      solver.callbacks                         = {watch};
      return solver;
    }

    /** The solver's own words name its variables and tolerances, which nobody has given. */
    std::string ending_of(const ceres::Solver::Summary &summary,
                          const LeastSquaresOptions    &options,
                          const EvaluatedResiduals     &evaluated)
    {
      if (2 * summary.final_cost <= options.smallest_sum)
        return "the sum of squares is as small as required";
      if (evaluated.evaluations() >= options.most_evaluations)
        return "as many evaluations as it may take";
      switch (summary.termination_type)
        {
        case ceres::CONVERGENCE:
          return "a step makes the sum of squares smaller by less than required";
        case ceres::USER_SUCCESS:
          return "its steps are much shorter than those of the differences";
        case ceres::NO_CONVERGENCE:
          return "as many steps as it may take";
        default:
          return "places around have no answer";
        }
    }

    /** Variables on a bound that the sum of squares pushes them against. */
    std::vector<int>
    held_by_bounds(const LeastSquaresProblem &problem, EvaluatedResiduals &evaluated, const Eigen::VectorXd &place)
    {
      std::vector<int> held;
      if (((place.array() > problem.lower.array()) && (place.array() < problem.upper.array())).all())
        return held;
      const auto jacobian = evaluated.jacobian(place);
      if (!jacobian)
        return held;
      const Eigen::VectorXd slope = jacobian->transpose() * *evaluated.at(place);
      for (int k = 0; k < place.size(); ++k)
        if ((place[k] <= problem.lower[k] && slope[k] > 0) || (place[k] >= problem.upper[k] && slope[k] < 0))
          held.push_back(k);
      return held;
    }

    /** Once from the place of the fit, which it moves, with some variables held. */
    void search(EvaluatedResiduals        &evaluated,
                const LeastSquaresProblem &problem,
                const LeastSquaresOptions &options,
                const std::vector<int>    &held,
                LeastSquaresFit           &fit)
    {
      const Eigen::VectorXd   place = fit.place;
      Eigen::VectorXd         ways  = Eigen::VectorXd::Zero(place.size());
      ceres::Problem::Options ownership;
      ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
      Cost           cost(evaluated, place, problem.steps);
      ceres::Problem model(ownership);
      model.AddResidualBlock(&cost, nullptr, ways.data());
      for (int k = 0; k < ways.size(); ++k)
        {
          if (std::isfinite(problem.lower[k]))
            model.SetParameterLowerBound(ways.data(), k, (problem.lower[k] - place[k]) / problem.steps[k]);
          if (std::isfinite(problem.upper[k]))
            model.SetParameterUpperBound(ways.data(), k, (problem.upper[k] - place[k]) / problem.steps[k]);
        }
      if (!held.empty())
        model.SetManifold(ways.data(),
                          new ceres::SubsetManifold(static_cast<int>(ways.size()), held)); // the model's own
      Watch                  watch(evaluated, options);
      ceres::Solver::Summary summary;
      ceres::Solve(solver_options(options, &watch), &model, &summary);
      fit.place     = cost.place(ways.data());
      fit.ending    = ending_of(summary, options, evaluated);
      fit.converged = summary.termination_type == ceres::CONVERGENCE;
    }
  } // namespace

  LeastSquaresFit least_squares(const LeastSquaresProblem &problem, const LeastSquaresOptions &options)
  {
    refuse_unusable(problem);
    EvaluatedResiduals evaluated(problem, options);
    LeastSquaresFit    fit;
    fit.place               = problem.start;
    double           before = evaluated.at(fit.place)->squaredNorm();
    std::vector<int> held   = held_by_bounds(problem, evaluated, fit.place);
    for (int round = 0; round < most_rounds && static_cast<Eigen::Index>(held.size()) < fit.place.size(); ++round)
      {
        const Eigen::VectorXd place = fit.place;
        search(evaluated, problem, options, held, fit);
        const bool by_differences = round > 0 || problem.first_jacobian.size() == 0; // at the beginning of this round
        const bool stays =
          by_differences && (fit.place - place).cwiseQuotient(problem.steps).norm() < options.smallest_step;
        const double after = evaluated.at(fit.place)->squaredNorm();
        const bool   gains = after < before * (1 - options.smallest_decrease);
        before             = after;
        fit.converged      = fit.converged || after <= options.smallest_sum;
        if (after <= options.smallest_sum || evaluated.evaluations() >= options.most_evaluations)
          break;
        // Steps that end on a bound are cut short for all variables, and an updated Jacobian may lead astray: it ends where those
        // that are free, by differences, gain nothing.
        const bool updated = evaluated.updated();
        evaluated.forget_jacobian();
        const std::vector<int> now   = held_by_bounds(problem, evaluated, fit.place);
        const bool             again = now != held || (updated && !stays) || (gains && !held.empty());
        held                         = now;
        if (!again)
          break;
      }
    evaluated.forget_jacobian();
    fit.residuals = *evaluated.at(fit.place);
    if (const auto slope = options.jacobian_at_end ? evaluated.jacobian(fit.place) : std::nullopt)
      fit.jacobian = *slope;
    fit.evaluations = evaluated.evaluations();
    fit.failed      = evaluated.failed();
    return fit;
  }
} // namespace optimisation
