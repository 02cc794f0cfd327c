#pragma once

#include "apps/optimisation/least_squares_search.h"

#include <functional>

namespace optimisation
{
  /** When the noise of a model, the distance of its answers from a smooth function of its variables, is measured. */
  enum class NoiseSearch
  {
    where_it_matters, ///< along one line first
    always,
    never
  };

  struct ModelAtEnd;

  struct NoiseOptions
  {
    NoiseSearch     search = NoiseSearch::where_it_matters;
    Eigen::VectorXd wide_steps;           ///< of differences that noise hardly touches, not below those of the problem
    double          deviation        = 0; ///< of a residual; 0: from the residuals
    double          of_concern       = 0.1;     ///< noise over that deviation from which on it matters
    int             most_evaluations = 1000000; ///< derivatives are taken anew only where that is possible with no more
    /** Asked after the first derivatives over wide steps, and their noise: false where these suffice to hold a variable, say. Empty: it goes on. */
    std::function<bool(const ModelAtEnd &so_far)> goes_on = {};
  };

  /** The end of a search, corrected for its noise. */
  struct ModelAtEnd
  {
    Eigen::VectorXd place, residuals; ///< those of the search where noise does not matter
    /** Of the residuals; where noise matters central, by wide steps, with zeros for variables on a bound; empty: it has none. */
    Eigen::MatrixXd jacobian;
    Eigen::MatrixXd noise; ///< draws of the noise of one answer, a column each; empty where it does not matter
    double          noise_degrees = 0; ///< how many independent draws they are worth
    double          share         = 1; ///< of the variance of one answer's noise in what the place was found from
    double of_column = 0; ///< expected squared norm of the noise in a column of the Jacobian, in units of wide steps
    double largest_noise = 0;     ///< root mean square over the residuals, in units of the deviation
    bool   cut_short     = false; ///< the last step was so long that derivatives should have been taken anew
    bool   leads_astray  = false; ///< the derivatives over wide steps lead to an answer worse than noise explains
    int    evaluations = 0, failed = 0;
  };

  /**
   * Derivatives and noise where a search has ended (doc/theory/studies.md, 8). The fourth difference along a line through the place, in all
   * variables at once, vanishes for a smooth model but for its fourth derivative. Where it shows noise that matters, the place is one of many
   * where the noise happens to make squares small: two steps of Gauss and Newton lead from there, by derivatives over wide steps and
   * residuals smoothed along such lines, none of which the search has seen. Derivatives are taken anew where a step was longer than half a wide
   * one and than a standard error. An answer that is worse than the search's by more than the noise explains is not taken.
   * @param options those of the search @param fit its end @throws base::InputError as least_squares()
   */
  ModelAtEnd model_at_end(const LeastSquaresProblem &problem,
                          const LeastSquaresOptions &options,
                          const LeastSquaresFit     &fit,
                          const NoiseOptions        &noise);
} // namespace optimisation
