#include "fem/materials/damage_plastic/damage_law.h"

#include <cmath>

namespace fem
{
  DamageLaw::DamageLaw(const double onset_strain_, const double opening_)
    : onset_strain(onset_strain_)
    , opening(opening_)
  {
  }

  double DamageLaw::largest_size() const noexcept { return opening / onset_strain; }

  DamageLaw::Integrity DamageLaw::integrity(const double kappa_d, const double size, const double offset) const noexcept
  {
    // psi = c exp(b psi) has its physical root below 1/b > 1. From psi = 1 Newton overshoots once (the residual is
    // concave) to the left of the root and then climbs to it without crossing; zero is a bound it never passes.
    const double b   = size * onset_strain / opening;
    const double c   = std::exp(-(size * kappa_d + offset) / opening - b);
    double       psi = 1;
    for (int i = 0; i < 100; ++i)
      {
        const double a    = c * std::exp(b * psi);
        const double next = std::fmax(psi - (psi - a) / (1 - b * a), 0.0);
        const bool   done = std::fabs(next - psi) <= 4e-16 * psi;
        psi               = next;
        if (done)
          break;
      }
    // psi' = -(size/opening) psi / (1 - b psi)
    return {psi, -(size / opening) * psi / (1 - b * psi)};
  }

  double DamageLaw::inverse(const double damage, const double size) const noexcept
  {
    return -opening / size * std::log1p(-damage) - damage * onset_strain;
  }
}
