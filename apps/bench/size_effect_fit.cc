#include "apps/bench/size_effect_fit.h"

#include "apps/optimisation/least_squares_search.h"
#include "apps/statistics/uncertainty.h"
#include "base/errors.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr double probability = 0.95;

    Estimate exponential_of(const statistics::Uncertainty &of, const Eigen::VectorXd &place, const int which)
    {
      const double value = std::exp(place[which]);
      return {value, value * of.half_width(which, probability), value * of.standard_errors[which]};
    }

    optimisation::LeastSquaresProblem
    problem_of(const std::vector<SizeStrength> &beams, const std::vector<ConstantRange> &ranges, const LogStrength &law)
    {
      const auto                        n = static_cast<Eigen::Index>(ranges.size());
      optimisation::LeastSquaresProblem problem;
      problem.start.resize(n);
      problem.lower.resize(n);
      problem.upper.resize(n);
      for (Eigen::Index i = 0; i < n; ++i)
        {
          const ConstantRange &range = ranges[static_cast<std::size_t>(i)];
          problem.start[i]           = std::log(range.start);
          problem.lower[i]           = std::log(range.lower);
          problem.upper[i]           = std::log(range.upper);
        }
      problem.steps     = Eigen::VectorXd::Constant(n, 1e-5);
      problem.residuals = [&beams, &law](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &place : places)
          {
            Eigen::VectorXd misfit(static_cast<Eigen::Index>(beams.size()));
            for (std::size_t i = 0; i < beams.size(); ++i)
              misfit[static_cast<Eigen::Index>(i)] =
                law(place.array().exp().matrix(), beams[i]) - std::log(beams[i].strength);
            all.emplace_back(misfit);
          }
        return all;
      };
      return problem;
    }
  } // namespace

  ConstantRange around(const double start)
  {
    constexpr double factor = 1e4;
    return {start, start / factor, start * factor};
  }

  void demand_sizes(const std::vector<SizeStrength> &beams)
  {
    const auto [least, most] = std::minmax_element(
      beams.begin(), beams.end(), [](const SizeStrength &a, const SizeStrength &b) { return a.depth < b.depth; });
    if (beams.size() < 3 || least->depth == most->depth)
      throw base::InputError("a law of size effect needs three beams at least, of two sizes at least.");
  }

  FittedConstants fitted_constants(const std::vector<SizeStrength>  &beams,
                                   const std::vector<ConstantRange> &ranges,
                                   const LogStrength                &law)
  {
    const optimisation::LeastSquaresProblem problem = problem_of(beams, ranges, law);
    optimisation::LeastSquaresOptions       how;
    how.central_differences                 = true;
    const optimisation::LeastSquaresFit fit = optimisation::least_squares(problem, how);
    statistics::UncertaintyOptions      held;
    const auto                          n = static_cast<int>(ranges.size());
    for (int i = 0; i < n; ++i)
      if (fit.place[i] <= problem.lower[i] || fit.place[i] >= problem.upper[i])
        held.held.push_back(i);
    const statistics::Uncertainty of =
      statistics::uncertainty(fit.jacobian, fit.residuals, Eigen::VectorXd::Ones(n), held);
    FittedConstants found;
    for (int i = 0; i < n; ++i)
      found.constants.push_back(exponential_of(of, fit.place, i));
    found.scatter = of.scatter;
    return found;
  }
} // namespace apps
