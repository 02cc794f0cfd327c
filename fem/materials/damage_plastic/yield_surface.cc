#include "fem/materials/damage_plastic/yield_surface.h"

#include "fem/materials/refuse.h"

#include <cmath>

namespace fem
{
  namespace
  {
    const double inv_sqrt6 = 1.0 / std::sqrt(6.0);
    const double sqrt1_5   = std::sqrt(1.5);
  }

  YieldSurface::YieldSurface(const DamagePlasticParameters &p)
    : e(p.eccentricity)
    , q0(p.initial_hardening)
    , ah(p.hardening_a)
    , bh(p.hardening_b)
    , ch(p.hardening_c)
    , dh(p.hardening_d)
    , eh(bh - dh)
    , fh(eh * ch / (ah - bh))
  {
    p.validate();
    const double fc = p.compressive_strength, ft = p.tensile_strength;
    m0              = 3 * (fc * fc - ft * ft) / (fc * ft) * e / (e + 1);
    ag              = 3 * ft / fc + m0 / 2;
    const double mc = (1 + 2 * p.dilation) / (p.dilation - 1) * (3 + m0 / 2);
    demand(mc > 0 && mc < ag, "Dilation", p.dilation,
           "no plastic potential fits these strengths with it (0 < M_c < A_g fails).");
    bg            = -(1.0 / 3.0) * (1 + ft / fc) / std::log(mc / ag);
    tension_shift = ft / (3 * fc);
  }

  double YieldSurface::yield(const double x, const double y, const double r, const double q) const noexcept
  {
    const double b = x + y * inv_sqrt6;
    const double a = (1 - q) * b * b + sqrt1_5 * y;
    return a * a + m0 * q * q * (x + y * r * inv_sqrt6) - q * q;
  }

  YieldValue
  YieldSurface::yield_and_derivatives(const double x, const double y, const double r, const double q) const noexcept
  {
    const double b    = x + y * inv_sqrt6;
    const double a    = (1 - q) * b * b + sqrt1_5 * y;
    const double ax   = 2 * (1 - q) * b;
    const double ay   = ax * inv_sqrt6 + sqrt1_5;
    const double cone = x + y * r * inv_sqrt6;

    YieldValue v;
    v.f = a * a + m0 * q * q * cone - q * q;
    v.x = 2 * a * ax + m0 * q * q;
    v.y = 2 * a * ay + m0 * q * q * r * inv_sqrt6;
    v.q = -2 * a * b * b + 2 * m0 * q * cone - 2 * q;
    v.r = m0 * q * q * y * inv_sqrt6;
    return v;
  }

  PotentialGradient YieldSurface::potential(const double x, const double y, const double q) const noexcept
  {
    const double b   = x + y * inv_sqrt6;
    const double a   = (1 - q) * b * b + sqrt1_5 * y;
    const double ax  = 2 * (1 - q) * b;
    const double ay  = ax * inv_sqrt6 + sqrt1_5;
    const double axx = 2 * (1 - q), axy = axx * inv_sqrt6, ayy = axy * inv_sqrt6;
    const double mg = ag * std::exp((x - tension_shift) / bg);

    PotentialGradient g;
    g.x  = 2 * a * ax + q * q * mg;
    g.y  = 2 * a * ay + m0 * q * q * inv_sqrt6;
    g.xx = 2 * ax * ax + 2 * a * axx + q * q * mg / bg;
    g.xy = 2 * ax * ay + 2 * a * axy;
    g.yy = 2 * ay * ay + 2 * a * ayy;
    g.xq = -2 * b * b * ax - 4 * a * b + 2 * q * mg;
    g.yq = -2 * b * b * ay - 4 * a * b * inv_sqrt6 + 2 * m0 * q * inv_sqrt6;
    return g;
  }

  Hardening YieldSurface::hardening(const double kappa) const noexcept
  {
    if (kappa <= 0)
      return {q0, 3 * (1 - q0)};
    if (kappa >= 1)
      return {1.0, 0.0};
    return {q0 + (1 - q0) * kappa * (kappa * (kappa - 3) + 3), 3 * (1 - q0) * (kappa - 1) * (kappa - 1)};
  }

  LodeRadius YieldSurface::lode_radius(const double theta) const noexcept
  {
    const double c = std::cos(theta), s = std::sin(theta);
    const double p = 4 * (1 - e * e), t = 2 * e - 1;
    const double root  = std::sqrt(p * c * c + 5 * e * e - 4 * e);
    const double num   = p * c * c + t * t;
    const double den   = p / 2 * c + t * root;
    const double num_c = 2 * p * c;
    const double den_c = p / 2 + t * p * c / root;
    return {num / den, -s * (num_c * den - num * den_c) / (den * den)};
  }

  Ductility YieldSurface::ductility(const double x) const noexcept
  {
    const double r = -x - 1.0 / 3.0;
    if (r >= 0)
      {
        const double decay = (ah - bh) * std::exp(-r / ch);
        return {ah - decay, -decay / ch};
      }
    const double grow = eh * std::exp(r / fh);
    return {grow + dh, -grow / fh};
  }
}
