#pragma once

#include <cmath>
#include <optional>

namespace fem
{
  /**
   * Root of a continuous function between two points of opposite sign, to the last few bits.
   *
   * False position with the Illinois weight (Dowell and Jarratt 1971), a bisection whenever three steps have not
   * halved the bracket: so never slower than three bisections.
   * @return nothing if the signs agree.
   */
  template <typename F>
  std::optional<double> bracketed_root(const F &f, double a, double b)
  {
    double fa = f(a), fb = f(b);
    if (fa == 0)
      return a;
    if (fb == 0)
      return b;
    if (!(fa * fb < 0))
      return std::nullopt;
    double width = std::fabs(b - a);
    int    since = 0;
    for (int i = 0; i < 300; ++i)
      {
        const bool halve = ++since > 3;
        double     c     = halve ? 0.5 * (a + b) : b - fb * (b - a) / (fb - fa);
        if (!(c > std::fmin(a, b) && c < std::fmax(a, b)))
          c = 0.5 * (a + b);
        if (c == a || c == b)
          return std::fabs(fa) < std::fabs(fb) ? a : b;
        const double fc = f(c);
        if (fc == 0)
          return c;
        if (fc * fb < 0)
          {
            a  = b;
            fa = fb;
          }
        else
          fa *= 0.5;
        b  = c;
        fb = fc;
        if (halve || std::fabs(b - a) <= 0.5 * width)
          {
            width = std::fabs(b - a);
            since = 0;
          }
      }
    return b;
  }
}
