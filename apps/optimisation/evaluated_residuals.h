#pragma once

#include "apps/optimisation/least_squares_search.h"

#include <map>

namespace optimisation
{
  /** @throws base::InputError for a start beyond the bounds, steps that are not positive, and sizes that differ */
  void refuse_unusable(const LeastSquaresProblem &problem);

  /** Residuals of a problem, each place evaluated once, and their Jacobian by differences and updates. */
  class EvaluatedResiduals
  {
  public:
    /** Evaluates the start. @throws base::InputError where that has no answer, or fewer residuals than variables */
    EvaluatedResiduals(const LeastSquaresProblem &problem, const LeastSquaresOptions &options);

    Eigen::Index    count() const { return residual_count; } ///< of residuals
    int             evaluations() const { return evaluated; }
    int             failed() const { return without_answer; }
    Eigen::VectorXd within_bounds(const Eigen::VectorXd &place) const;

    std::optional<Eigen::VectorXd> at(const Eigen::VectorXd &place);
    /** Those that at() will return, evaluated at the same time. */
    void prepare(const std::vector<Eigen::VectorXd> &places) { evaluate(places); }
    /** From now on Jacobians are without derivatives by these variables: their columns are zero. */
    void leave_out(const std::vector<int> &variables) { left_out = variables; }
    /** Nothing where a variable can be moved neither up nor down. */
    std::optional<Eigen::MatrixXd> jacobian(const Eigen::VectorXd &place);
    /** Whether the last one was updated, not by differences. */
    bool updated() const { return was_updated; }
    /** The next one is by differences. */
    void forget_jacobian() { known_jacobian.reset(); }

  private:
    using Key = std::vector<double>;
    bool       asks_for(Eigen::Index variable) const;
    static Key key_of(const Eigen::VectorXd &place) { return Key(place.begin(), place.end()); }

    void                           evaluate(const std::vector<Eigen::VectorXd> &places);
    std::optional<Eigen::VectorXd> slope(const Eigen::VectorXd &place, Eigen::Index variable);
    Eigen::VectorXd                moved(const Eigen::VectorXd &place, Eigen::Index variable, double steps) const;
    std::vector<Eigen::VectorXd>   places_for_differences(const Eigen::VectorXd &place) const;
    void                           update_jacobian(const Eigen::VectorXd &place, const Eigen::VectorXd &residuals);

    const LeastSquaresProblem                    &problem;
    const LeastSquaresOptions                    &options;
    std::map<Key, std::optional<Eigen::VectorXd>> answers;
    Eigen::Index                                  residual_count = 0;
    int                                           evaluated = 0, without_answer = 0;
    bool                                          was_updated = false;
    std::vector<int>                              left_out;
    std::optional<Eigen::MatrixXd>                known_jacobian;
    Eigen::VectorXd                               known_place, known_residuals; ///< where that is known
  };
} // namespace optimisation
