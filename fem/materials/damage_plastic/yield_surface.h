#pragma once

#include "fem/materials/damage_plastic/parameters.h"

namespace fem
{
  /// Hardening q(kappa) and its slope, Grassl and Jirasek (2006).
  struct Hardening
  {
    double value, slope;
  };

  /// Elliptic deviatoric section r(theta), Menetrey and Willam (1995), and its slope.
  struct LodeRadius
  {
    double value, slope;
  };

  /// Ductility measure x_h and its derivative with respect to x = sigma_V / f_c.
  struct Ductility
  {
    double value, slope;
  };

  /// Yield function and derivatives. x = sigma_V / f_c, y = rho / f_c.
  struct YieldValue
  {
    double f, x, y, q, r;
  };

  /// Gradient of the plastic potential and its derivatives, in x, y and q.
  struct PotentialGradient
  {
    double x, y, xx, xy, yy, xq, yq;
  };

  /// Yield surface, plastic potential and hardening of Grassl and Jirasek (2006), over f_c; doc/theory/damage-plastic-concrete.md, 2.
  class YieldSurface
  {
  public:
    explicit YieldSurface(const DamagePlasticParameters &parameters);

    /// f(x, y, r, q): negative inside. Unit 1.
    double yield(double x, double y, double r, double q) const noexcept;

    YieldValue        yield_and_derivatives(double x, double y, double r, double q) const noexcept;
    PotentialGradient potential(double x, double y, double q) const noexcept;
    Hardening         hardening(double kappa) const noexcept;
    LodeRadius        lode_radius(double theta) const noexcept;
    Ductility         ductility(double x) const noexcept;

    double friction() const noexcept ///< m_0
    {
      return m0;
    }
    double dilation_a() const noexcept ///< A_g
    {
      return ag;
    }
    double dilation_b() const noexcept ///< B_g
    {
      return bg;
    }

  private:
    double e, q0, m0, ag, bg, tension_shift; // f_t / (3 f_c)
    double ah, bh, ch, dh, eh, fh;
  };
}
