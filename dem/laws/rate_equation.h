#pragma once

#include "dem/core/exponential.h"
#include "dem/core/logarithm.h"

namespace dem
{
  /**
   * The beta <= 0 with e^beta + c e^(M beta) = 1: the part e^beta of an increment that happens within one implicit step, where the
   * rest makes an overstress that goes with the power M of the rate (doc/theory/cpm-options.md, 3).
   *
   * Newton's method for f(beta) = ln(e^beta + c e^(M beta)), which rises and is convex: from beta = 0, where f > 0, it falls onto the root
   * without overshoot. Each number stops by itself, so that a link's result does not depend on those beside it.
   *
   * @param log_factor ln c @param exponent M > 0
   */
  template <typename T>
  BRECCIA_BRANCH T solve_rate_equation(const T &log_factor, const T &exponent)
  {
    constexpr int most = 60; // enough for any c that a double can hold: far from the root f is nearly a straight line
    T             beta = T(0.0);
    for (int i = 0; i < most; ++i)
      {
        const T    slow = multiply_add(exponent, beta, log_factor), larger = maximum(beta, slow);
        const T    of_beta = exponential(T(beta - larger)), of_slow = exponential(T(slow - larger));
        const T    sum  = of_beta + of_slow;
        const T    f    = larger + logarithm(sum);
        const T    step = f * sum / multiply_add(exponent, of_slow, of_beta);
        const T    size = maximum(T(1.0), T(0.0) - beta);
        const auto on   = step > T(1e-15) * size;
        if (!any(on))
          break;
        beta = select(on, beta - step, beta);
      }
    return beta;
  }
} // namespace dem
