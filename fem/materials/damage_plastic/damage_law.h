#pragma once

#include "fem/materials/damage_plastic/softening_curve.h"

namespace fem
{
  /// Damage regularised by element size: 1 - omega = g((h/w_f)(kappa_D + omega f_t/E)); doc/theory/damage-plastic-concrete.md, 3.
  class DamageLaw
  {
  public:
    /// @param onset_strain f_t/E [-]; @param opening w_f [m].
    DamageLaw(double onset_strain, double opening, const SofteningCurve &curve = {});

    /// Largest element size that the law can regularise, E w_f / f_t over the curve's steepest slope [m].
    double largest_size() const noexcept;

    /// Integrity 1 - omega that solves the law with an offset in its exponent; d integrity / d kappa_D beside it.
    struct Integrity
    {
      double value, slope;
    };

    /// @param size h [m], below largest_size(). @param offset added to h (kappa_D + omega f_t/E) [m].
    Integrity integrity(double kappa_d, double size, double offset = 0.0) const noexcept;

    /// kappa_D that gives this damage at this size [-]. @pre 0 <= damage < 1.
    double inverse(double damage, double size) const noexcept;

  private:
    Integrity on_curve(double driven, double b, double size) const noexcept;

    double         onset_strain, opening;
    SofteningCurve curve;
  };
}
