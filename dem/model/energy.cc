#include "dem/model/energy.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  double EnergyAccount::balance_error() const
  {
    const double dissipated = damage + friction + released + damping;
    const double largest = std::max({std::abs(initial) + std::abs(external_work) + std::abs(gravity), std::abs(kinetic),
                                     std::abs(elastic), std::abs(dissipated), rounding});
    return largest > 0 ? std::abs(residual()) / largest : 0.0;
  }
} // namespace dem
