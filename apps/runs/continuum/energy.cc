#include "apps/runs/continuum/energy.h"

#include <algorithm>

namespace apps
{
  double ContinuumEnergy::largest() const
  {
    return std::max({std::fabs(external), std::fabs(internal), std::fabs(stored), std::fabs(dissipated),
                     std::fabs(contacts), kinetic, damped, start});
  }

  double ContinuumEnergy::balance_error() const
  {
    const double most = largest();
    return most > 0 ? std::fabs(residual()) / most : 0.0;
  }
} // namespace apps
