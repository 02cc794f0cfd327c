#include "fem/materials/damage_plastic/softening_curve.h"

#include <cmath>

namespace fem
{
  SofteningCurve::Point SofteningCurve::at(const double y) const
  {
    const double fast = (1 - residual) * std::exp(-std::pow(y, exponent)), slow = residual * std::exp(-y / stretch);
    return {fast + slow, -fast * exponent * std::pow(y, exponent - 1) - slow / stretch};
  }

  double SofteningCurve::opening(const double value) const
  {
    if (exponential())
      return -std::log(value);
    if (value >= 1)
      return 0;
    double high = 1; // grows until it brackets the value
    while (at(high).value > value)
      high *= 2;
    double low = 0;
    for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) // g is flat where Newton would leap: halve
      {
        const double middle                     = 0.5 * (low + high);
        (at(middle).value > value ? low : high) = middle;
      }
    return 0.5 * (low + high);
  }

  double SofteningCurve::area() const
  {
    return exponential() ? 1 : (1 - residual) * std::tgamma(1 + 1 / exponent) + residual * stretch;
  }

  double SofteningCurve::steepest() const
  {
    // Of the fast part where its second derivative vanishes, y^n = (n-1)/n; of the slow one at once. Their sum bounds that of g.
    const double part = (exponent - 1) / exponent;
    return (1 - residual) * exponent * (part > 0 ? std::pow(part, part) : 1.0) * std::exp(-part) + residual / stretch;
  }
}
