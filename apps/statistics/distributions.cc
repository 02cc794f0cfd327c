#include "apps/statistics/distributions.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace statistics
{
  namespace
  {
    constexpr double no_probability = std::numeric_limits<double>::quiet_NaN();

    void demand_limit(const double probability, const double degrees)
    {
      if (!(probability > 0 && probability < 1 && degrees >= 1))
        throw std::invalid_argument("a limit wants a probability between 0 and 1 and one degree of freedom at least");
    }
  } // namespace

  double f_probability_above(const double ratio, const double numerator_degrees, const double denominator_degrees)
  {
    if (std::isnan(ratio) || !(numerator_degrees >= 1 && denominator_degrees >= 1))
      return no_probability;
    if (std::isinf(ratio))
      return 0;
    return cdf(complement(boost::math::fisher_f(numerator_degrees, denominator_degrees), std::fmax(ratio, 0)));
  }

  double f_limit(const double probability_above, const double numerator_degrees, const double denominator_degrees)
  {
    demand_limit(probability_above, std::fmin(numerator_degrees, denominator_degrees));
    return quantile(complement(boost::math::fisher_f(numerator_degrees, denominator_degrees), probability_above));
  }

  double t_probability_beyond(const double t, const double degrees)
  {
    if (std::isnan(t) || !(degrees >= 1))
      return no_probability;
    if (std::isinf(t))
      return 0;
    return 2 * cdf(complement(boost::math::students_t(degrees), std::fabs(t)));
  }

  double t_limit(const double probability_above, const double degrees)
  {
    demand_limit(probability_above, degrees);
    return quantile(complement(boost::math::students_t(degrees), probability_above));
  }

  double half_normal_quantile(const double probability)
  {
    demand_limit(probability, 1);
    return quantile(boost::math::normal(), (1 + probability) / 2);
  }
} // namespace statistics
