#pragma once

#include "apps/optimisation/least_squares_search.h"

namespace optimisation
{
  /**
   * The same problem without derivatives, for models whose noise makes differences useless: Rowan's subplex method of NLopt, from the
   * start, in finite bounds (doc/theory/studies.md, 10). A place without an answer counts ten times the sum of squares of the start. It
   * ends once steps are below a tenth of those of the differences, or by the options; the Jacobian is by differences at the end.
   *
   * @throws base::InputError as least_squares, and for an infinite bound
   */
  LeastSquaresFit direct_search(const LeastSquaresProblem &problem, const LeastSquaresOptions &options);
} // namespace optimisation
