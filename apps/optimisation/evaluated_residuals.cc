#include "apps/optimisation/evaluated_residuals.h"

#include "base/errors.h"

#include <algorithm>

namespace optimisation
{
  void refuse_unusable(const LeastSquaresProblem &problem)
  {
    const Eigen::Index n = problem.start.size();
    if (n < 1 || problem.lower.size() != n || problem.upper.size() != n || problem.steps.size() != n)
      throw base::InputError("least squares: bounds and steps are wanted for each variable, and one at least.");
    if (!(problem.start.array() >= problem.lower.array()).all() ||
        !(problem.start.array() <= problem.upper.array()).all() || !(problem.steps.array() > 0).all())
      throw base::InputError("least squares: the start must lie within the bounds, and steps must be positive.");
  }

  EvaluatedResiduals::EvaluatedResiduals(const LeastSquaresProblem &problem_, const LeastSquaresOptions &options_)
    : problem(problem_)
    , options(options_)
  {
    const auto first = at(problem.start);
    if (!first)
      throw base::InputError("least squares: there is no answer for the start.");
    residual_count = first->size();
    if (residual_count < problem.start.size())
      throw base::InputError("least squares: there are fewer residuals (" + std::to_string(residual_count) +
                             ") than variables (" + std::to_string(problem.start.size()) + ").");
    if (options.updated_jacobian && problem.first_jacobian.size() > 0)
      {
        known_jacobian  = problem.first_jacobian;
        known_place     = problem.start;
        known_residuals = *first;
      }
  }

  Eigen::VectorXd EvaluatedResiduals::within_bounds(const Eigen::VectorXd &place) const
  {
    return place.cwiseMax(problem.lower).cwiseMin(problem.upper);
  }

  void EvaluatedResiduals::evaluate(const std::vector<Eigen::VectorXd> &places)
  {
    std::vector<Eigen::VectorXd> fresh;
    for (const Eigen::VectorXd &place : places)
      if (answers.find(key_of(place)) == answers.end())
        fresh.push_back(place);
    if (fresh.empty())
      return;
    auto found = problem.residuals(fresh);
    for (std::size_t k = 0; k < fresh.size(); ++k)
      {
        if (found[k] && !found[k]->allFinite())
          found[k].reset();
        without_answer += !found[k];
        answers[key_of(fresh[k])] = std::move(found[k]);
      }
    evaluated += static_cast<int>(fresh.size());
  }

  std::optional<Eigen::VectorXd> EvaluatedResiduals::at(const Eigen::VectorXd &place)
  {
    evaluate({place});
    return answers.at(key_of(place));
  }

  Eigen::VectorXd
  EvaluatedResiduals::moved(const Eigen::VectorXd &place, const Eigen::Index variable, const double steps) const
  {
    Eigen::VectorXd other = place;
    other[variable] += steps * problem.steps[variable];
    return within_bounds(other);
  }

  bool EvaluatedResiduals::asks_for(const Eigen::Index variable) const
  {
    return std::find(left_out.begin(), left_out.end(), variable) == left_out.end();
  }

  std::vector<Eigen::VectorXd> EvaluatedResiduals::places_for_differences(const Eigen::VectorXd &place) const
  {
    std::vector<Eigen::VectorXd> places = {place};
    for (Eigen::Index k = 0; k < place.size(); ++k)
      {
        if (!asks_for(k))
          continue;
        const Eigen::VectorXd up   = moved(place, k, 1);
        const bool            full = up[k] - place[k] >= problem.steps[k] / 2;
        if (full)
          places.push_back(up);
        if (options.central_differences || !full)
          places.push_back(moved(place, k, -1));
      }
    return places;
  }

  /** By the places up and down that have an answer: both, one, or one down where up has none. */
  std::optional<Eigen::VectorXd> EvaluatedResiduals::slope(const Eigen::VectorXd &place, const Eigen::Index variable)
  {
    const Eigen::VectorXd own = *at(place);
    const Eigen::VectorXd up = moved(place, variable, 1), down = moved(place, variable, -1);
    const auto            known = [this, &place](const Eigen::VectorXd &other) -> std::optional<Eigen::VectorXd> {
      const auto found = answers.find(key_of(other));
      return other == place || found == answers.end() ? std::nullopt : found->second;
    };
    const auto above = known(up);
    auto       below = known(down);
    if (!above && !below && down != place)
      below = at(down);
    if (above && below && options.central_differences)
      return (*above - *below) / (up[variable] - down[variable]);
    if (above)
      return (*above - own) / (up[variable] - place[variable]);
    if (below)
      return (own - *below) / (place[variable] - down[variable]);
    return std::nullopt;
  }

  void EvaluatedResiduals::update_jacobian(const Eigen::VectorXd &place, const Eigen::VectorXd &residuals)
  {
    const Eigen::VectorXd way = (place - known_place).cwiseQuotient(problem.steps); // in steps: all of one size
    if (way.squaredNorm() > 0)
      *known_jacobian += (residuals - known_residuals - *known_jacobian * (place - known_place)) *
                         way.cwiseQuotient(problem.steps).transpose() / way.squaredNorm();
  }

  std::optional<Eigen::MatrixXd> EvaluatedResiduals::jacobian(const Eigen::VectorXd &place)
  {
    const auto own = at(place);
    if (!own)
      return std::nullopt;
    was_updated = known_jacobian && options.updated_jacobian;
    if (was_updated)
      update_jacobian(place, *own);
    else
      {
        evaluate(places_for_differences(place));
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(own->size(), place.size());
        for (Eigen::Index k = 0; k < place.size(); ++k)
          {
            if (!asks_for(k))
              continue;
            const auto column = slope(place, k);
            if (!column)
              return std::nullopt;
            matrix.col(k) = *column;
          }
        known_jacobian = matrix;
      }
    known_place     = place;
    known_residuals = *own;
    return known_jacobian;
  }
} // namespace optimisation
