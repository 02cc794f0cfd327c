#include "dem/laws/restitution.h"

#include <cmath>

namespace dem
{
  double damping_ratio_of(const double restitution)
  {
    const double logarithm = std::log(restitution);
    return -logarithm / std::sqrt(M_PI * M_PI + logarithm * logarithm);
  }
} // namespace dem
