#include "apps/optimisation/references.h"

#include "apps/optimisation/least_squares_search.h"
#include "apps/optimisation/nist_problems.h"
#include "apps/statistics/uncertainty.h"

#include <cmath>
#include <string>

namespace optimisation
{
  namespace
  {
    Eigen::VectorXd vector_of(const ReferenceProblem::Constants &values)
    {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
    }

    Eigen::VectorXd residuals_of(const ReferenceProblem &reference, const Eigen::VectorXd &b)
    {
      Eigen::VectorXd residuals(reference.x.size());
      for (std::size_t k = 0; k < reference.x.size(); ++k)
        residuals[k] = reference.model(b, reference.x[k]) - reference.y[k];
      return residuals;
    }

    LeastSquaresFit fitted(const ReferenceProblem &reference, const Eigen::VectorXd &start)
    {
      const Eigen::VectorXd infinite = Eigen::VectorXd::Constant(start.size(), INFINITY);
      LeastSquaresOptions   options;
      options.central_differences = true;
      options.most_evaluations    = 100000;
      options.smallest_decrease   = 1e-15;
      const auto residuals        = [&reference](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &b : places)
          all.push_back(residuals_of(reference, b));
        return all;
      };
      return least_squares({start, -infinite, infinite, 1e-5 * start.cwiseAbs(), residuals}, options);
    }

    /** Of the fits from both starts the value that errs more. */
    double worse(const std::vector<double> &found, const double certified)
    {
      double worst = found.front();
      for (const double value : found)
        if (!(std::fabs(value - certified) <= std::fabs(worst - certified)))
          worst = value;
      return worst;
    }

    void certified_constants(base::Comparisons &rows)
    {
      for (const ReferenceProblem &problem : nist_problems)
        {
          const Eigen::VectorXd            certified = vector_of(problem.certified);
          std::vector<double>              sums;
          std::vector<std::vector<double>> constants(problem.certified.size()), errors(problem.certified.size());
          for (const ReferenceProblem::Constants &start : problem.starts)
            {
              LeastSquaresFit fit = fitted(problem, vector_of(start));
              fit = fitted(problem, fit.place); // once more, with differences as wide as suit the answer
              const statistics::Uncertainty sure =
                statistics::uncertainty(fit.jacobian, fit.residuals, fit.place.cwiseAbs(), {{}, 0, 1e14});
              sums.push_back(fit.sum_of_squares());
              for (std::size_t k = 0; k < constants.size(); ++k)
                {
                  constants[k].push_back(fit.place[static_cast<Eigen::Index>(k)]);
                  errors[k].push_back(sure.standard_errors[static_cast<Eigen::Index>(k)]);
                }
            }
          rows.of(problem.name + ": sum of squares as typed", "", residuals_of(problem, certified).squaredNorm())
            .within(1e-9, problem.sum_of_squares);
          rows.of(problem.name + ": sum of squares", "", worse(sums, problem.sum_of_squares))
            .within(1e-9, problem.sum_of_squares);
          for (std::size_t k = 0; k < constants.size(); ++k)
            {
              const std::string name = problem.name + ": b" + std::to_string(k + 1);
              rows.of(name, "", worse(constants[k], problem.certified[k])).within(1e-6, problem.certified[k]);
              rows.of(name + ", standard error", "", worse(errors[k], problem.standard_errors[k]))
                .within(1e-6, problem.standard_errors[k]);
            }
        }
    }
  } // namespace

  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"least squares: non-linear problems from two starts",
       "Statistical Reference Datasets, National Institute of Standards and Technology", certified_constants}};
    return all;
  }
} // namespace optimisation
