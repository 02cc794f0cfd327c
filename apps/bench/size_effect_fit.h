#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace apps
{
  /** Nominal strength of a beam: a run of a packing each. */
  struct SizeStrength
  {
    double depth = 0, strength = 0; ///< D [m], sigma_N = 3 P S/(2 b D^2) [Pa]
    double notch = 0;               ///< alpha, depth of its notch over D; 0: none
  };

  /** A number, and how sure it is. */
  struct Estimate
  {
    double value          = std::numeric_limits<double>::quiet_NaN();
    double half_width     = std::numeric_limits<double>::quiet_NaN(); ///< of the band that holds it with 95 %
    double standard_error = std::numeric_limits<double>::quiet_NaN();

    bool determined() const { return std::isfinite(half_width); }
  };

  /** Where a constant is sought, all above zero. */
  struct ConstantRange
  {
    double start = 1, lower = 0, upper = 1;
  };

  struct FittedConstants
  {
    std::vector<Estimate> constants;
    double                scatter = 0; ///< standard deviation of ln sigma_N about the law [-]
  };

  /** ln sigma_N of a law with these constants. */
  using LogStrength = std::function<double(const Eigen::VectorXd &constants, const SizeStrength &beam)>;

  /** A factor of ten thousand both ways. */
  ConstantRange around(double start);

  /**
   * Constants of a law of size effect by least squares of ln sigma_N, sought by their logarithms, so that none can be negative
   * (doc/theory/size-effect.md, 1). One that ends on its bound is not determined.
   * @throws base::InputError for as many constants as beams, or more
   */
  FittedConstants fitted_constants(const std::vector<SizeStrength>  &beams,
                                   const std::vector<ConstantRange> &ranges,
                                   const LogStrength                &law);

  /** @throws base::InputError for fewer than three beams, or sizes that are all the same */
  void demand_sizes(const std::vector<SizeStrength> &beams);
} // namespace apps
