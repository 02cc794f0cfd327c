#pragma once

namespace fem
{
  /**
   * Strength left over opening: g(y) = (1 - r) exp(-y^n) + r exp(-y/b), y in units of w_f (doc/theory/late-transfers.md, 3).
   *
   * n = 1, r = 0 is the exponential of Grassl and Jirasek (2006). Crushed concrete loses its strength slowly at first, then fast, and
   * what friction holds much later: n about 2 and a residual share.
   */
  struct SofteningCurve
  {
    double exponent = 1.0, residual = 0.0, stretch = 20.0; ///< n, r, b

    bool exponential() const { return exponent == 1 && residual == 0; }

    struct Point
    {
      double value, slope;
    };

    /// g and g' at y >= 0.
    Point at(double y) const;

    /// The opening y at which g is the given value in (0, 1].
    double opening(double value) const;

    /// Integral of g over all openings.
    double area() const;

    /// Largest -g'.
    double steepest() const;
  };
}
