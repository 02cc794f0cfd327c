#pragma once

#include <vector>

namespace apps
{
  /** y = intercept + slope x. */
  struct FittedLine
  {
    double intercept = 0, slope = 0;

    double at(const double x) const { return intercept + slope * x; }
  };

  /** By least squares; NaN where a value is, or all x are the same. @pre as many x as y, at least one */
  FittedLine line_through(const std::vector<double> &x, const std::vector<double> &y);
} // namespace apps
