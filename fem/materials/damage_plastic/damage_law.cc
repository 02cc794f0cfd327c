#include "fem/materials/damage_plastic/damage_law.h"

#include <cmath>

namespace fem
{
  DamageLaw::DamageLaw(const double onset_strain_, const double opening_, const SofteningCurve &curve_)
    : onset_strain(onset_strain_)
    , opening(opening_)
    , curve(curve_)
  {
  }

  double DamageLaw::largest_size() const noexcept { return opening / onset_strain / curve.steepest(); }

  DamageLaw::Integrity DamageLaw::integrity(const double kappa_d, const double size, const double offset) const noexcept
  {
    // psi = c exp(b psi) has its physical root below 1/b > 1. From psi = 1 Newton overshoots once (the residual is
    // concave) to the left of the root and then climbs to it without crossing; zero is a bound it never passes.
    const double b = size * onset_strain / opening;
    if (!curve.exponential())
      return on_curve((size * kappa_d + offset) / opening, b, size);
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

  /// psi = g(driven + b (1 - psi)): below largest_size() psi - g grows with psi, and has one root in [0, 1].
  DamageLaw::Integrity DamageLaw::on_curve(const double driven, const double b, const double size) const noexcept
  {
    double low = 0, high = 1, psi = curve.at(driven).value;
    for (int i = 0; i < 100; ++i)
      {
        const auto   g              = curve.at(driven + b * (1 - psi));
        const double residual       = psi - g.value;
        (residual > 0 ? high : low) = psi;
        double next                 = psi - residual / (1 + b * g.slope);
        if (!(next > low && next < high))
          next = 0.5 * (low + high);
        const bool done = std::fabs(next - psi) <= 4e-16 * psi;
        psi             = next;
        if (done)
          break;
      }
    const double slope = curve.at(driven + b * (1 - psi)).slope;
    return {psi, (size / opening) * slope / (1 + b * slope)};
  }

  double DamageLaw::inverse(const double damage, const double size) const noexcept
  {
    if (!curve.exponential())
      return opening / size * curve.opening(1 - damage) - damage * onset_strain;
    return -opening / size * std::log1p(-damage) - damage * onset_strain;
  }
}
