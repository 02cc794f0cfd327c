#include "fem/materials/damage_plastic/return_mapping.h"

#include "fem/materials/bracketed_root.h"

#include <cmath>

namespace fem
{
  namespace
  {
    // (2 cos theta)^2: the factor behind the paper's own results (the printed one lacks the 4).
    double lode_factor(const double theta) { return 4 * std::cos(theta) * std::cos(theta); }

    // Slope rho / |sigma_V - sigma| of the cone around the axis, well inside the slopes that the potential returns to it.
    constexpr double vertex_cone = 0.1;

    // kappa grows to thousands in tension, stresses to hundreds of f_c in confined compression: residuals are relative to them.
    double scaled_norm(const Eigen::Vector4d &residual, const double x, const double kappa)
    {
      const double stress = 1 + std::fabs(x);
      return Eigen::Vector4d(residual[0] / stress, residual[1] / stress, residual[2] / (1 + std::fabs(kappa)),
                             residual[3] / stress)
        .norm();
    }
  }

  ReturnMapping::ReturnMapping(const DamagePlasticParameters &p)
    : yield_surface(p)
    , bulk_over_shear(p.bulk() / (2 * p.shear()))
    , strain_unit(p.compressive_strength / (2 * p.shear()))
    , vertex_norm(p.vertex_norm)
    , tensile_ratio(p.tensile_strength / p.compressive_strength)
  {
  }

  std::optional<PlasticReturn> ReturnMapping::operator()(const PlasticTrial &trial) const
  {
    const double q = yield_surface.hardening(trial.kappa).value;
    const double r = yield_surface.lode_radius(trial.theta).value;
    if (yield_surface.yield(trial.x, trial.y, r, q) <= tolerance)
      {
        PlasticReturn elastic{trial.x, trial.y, trial.kappa, ReturnKind::elastic, Eigen::Matrix<double, 3, 4>::Zero()};
        elastic.sensitivity(0, 0) = elastic.sensitivity(1, 1) = elastic.sensitivity(2, 3) = 1;
        return elastic;
      }
    if (const auto apex = vertex(trial, vertex_cone))
      return apex;
    if (const auto side = regular(trial))
      return side;
    // Where the potential returns to the axis at a flatter slope than the cone: the vertex that meets the regular return.
    return vertex(trial, 0.0);
  }

  ReturnMapping::System ReturnMapping::equations(const Unknowns &z, const PlasticTrial &t) const
  {
    const Hardening         q = yield_surface.hardening(z.kappa);
    const LodeRadius        r = yield_surface.lode_radius(t.theta);
    const YieldValue        f = yield_surface.yield_and_derivatives(z.x, z.y, r.value, q.value);
    const PotentialGradient g = yield_surface.potential(z.x, z.y, q.value);
    const Ductility         h = yield_surface.ductility(z.x);

    const double n     = std::sqrt(g.x * g.x / 3 + g.y * g.y);
    const double n_x   = (g.x * g.xx / 3 + g.y * g.xy) / n;
    const double n_y   = (g.x * g.xy / 3 + g.y * g.yy) / n;
    const double n_q   = (g.x * g.xq / 3 + g.y * g.yq) / n;
    const double scale = strain_unit * lode_factor(t.theta) / h.value;
    const double l     = z.multiplier;

    System s;
    s.residual << z.x - t.x + bulk_over_shear * l * g.x, z.y - t.y + l * g.y, t.kappa - z.kappa + l * scale * n, f.f;
    s.jacobian << 1 + bulk_over_shear * l * g.xx, bulk_over_shear * l * g.xy, bulk_over_shear * l * g.xq * q.slope,
      bulk_over_shear * g.x,                                                                                //
      l * g.xy, 1 + l * g.yy, l * g.yq * q.slope, g.y,                                                      //
      l * scale * (n_x - n * h.slope / h.value), l * scale * n_y, l * scale * n_q * q.slope - 1, scale * n, //
      f.x, f.y, f.q * q.slope, 0;
    return s;
  }

  std::optional<ReturnMapping::Unknowns>
  ReturnMapping::newton(Unknowns z, const PlasticTrial &trial, const bool hardening_frozen) const
  {
    const auto evaluate = [&](const Unknowns &u) {
      System s = equations(u, trial);
      if (hardening_frozen)
        {
          s.residual[2] = 0;
          s.jacobian.row(2) << 0, 0, 1, 0;
        }
      else if (s.jacobian(3, 2) > 0)
        s.jacobian(3, 2) = 0; // positive only far outside the surface, where it misleads
      return s;
    };

    System s    = evaluate(z);
    double norm = scaled_norm(s.residual, z.x, z.kappa);
    bool   done = false;
    for (int iteration = 0; iteration < 60 && std::isfinite(norm); ++iteration)
      {
        const Eigen::Vector4d step = s.jacobian.partialPivLu().solve(-s.residual);
        double                a    = 1;
        if (step[1] < 0 && z.y + step[1] < 0)
          a = std::fmin(a, -0.9 * z.y / step[1]);

        bool improved = false;
        for (int cut = 0; cut < 12; ++cut, a /= 2)
          {
            const Unknowns next{z.x + a * step[0], z.y + a * step[1], std::fmax(z.kappa + a * step[2], trial.kappa),
                                z.multiplier + a * step[3]};
            const System   s_next    = evaluate(next);
            const double   norm_next = scaled_norm(s_next.residual, next.x, next.kappa);
            if (norm_next < norm * (1 - 1e-4 * a))
              {
                z        = next;
                s        = s_next;
                norm     = norm_next;
                improved = true;
                break;
              }
          }
        if (done || (!improved && norm <= tolerance))
          return z; // one step beyond the tolerance: Newton's last step is nearly free of error
        if (!improved)
          return std::nullopt;
        done = norm <= tolerance;
      }
    return std::nullopt;
  }

  /// Return to the surface of q = 1, where x is an explicit function of y: one bracketed equation in y.
  std::optional<ReturnMapping::Unknowns> ReturnMapping::at_strength(const PlasticTrial &t) const
  {
    const double r         = yield_surface.lode_radius(t.theta).value;
    const double m0        = yield_surface.friction();
    const auto   surface_x = [&](const double y) { return (1 - 1.5 * y * y) / m0 - y * r / std::sqrt(6.0); };
    const auto   off_line  = [&](const double y) { // the end must lie along the potential's gradient from the trial
      const double            x = surface_x(y);
      const PotentialGradient g = yield_surface.potential(x, y, 1.0);
      return (t.x - x) * g.y - bulk_over_shear * (t.y - y) * g.x;
    };
    const auto y = bracketed_root(off_line, 0.0, t.y);
    if (!y)
      return std::nullopt;
    const double            x = surface_x(*y);
    const PotentialGradient g = yield_surface.potential(x, *y, 1.0);
    const double            l = (t.y - *y) / g.y;
    const double            k =
      l * std::sqrt(g.x * g.x / 3 + g.y * g.y) * strain_unit * lode_factor(t.theta) / yield_surface.ductility(x).value;
    return Unknowns{x, *y, t.kappa + k, l};
  }

  /// Root in kappa of the hardening equation, the stress returned to the surface of each kappa: slow, always brackets.
  std::optional<ReturnMapping::Unknowns> ReturnMapping::nested(const PlasticTrial &trial) const
  {
    if (const auto beyond = at_strength(trial))
      if (beyond->kappa >= 1)
        return beyond;
    const double            r = yield_surface.lode_radius(trial.theta).value;
    std::optional<Unknowns> last;
    bool                    failed = false;
    const auto              excess = [&](const double kappa) {
      const Unknowns start{trial.x, trial.y, kappa, 0};
      const bool     inside = yield_surface.yield(trial.x, trial.y, r, yield_surface.hardening(kappa).value) <= 0;
      last                  = inside ? start : newton(start, trial, true);
      failed                = failed || !last;
      return last ? equations(*last, trial).residual[2] : 0.0;
    };
    const auto kappa = bracketed_root(excess, trial.kappa, 1.0);
    if (!kappa || failed)
      return std::nullopt;
    excess(*kappa);
    return failed ? std::nullopt : newton(*last, trial, false);
  }

  /// Newton from harder surfaces and shorter deviators: next to the vertex the way from the trial state is not monotone.
  std::optional<ReturnMapping::Unknowns> ReturnMapping::from_other_starts(const PlasticTrial &trial) const
  {
    for (const double harder : {1e-3, 0.05, 0.3})
      for (const double shrink : {1.0, 0.5, 0.1})
        {
          const double            kappa = trial.kappa + harder, y = shrink * trial.y;
          const PotentialGradient g = yield_surface.potential(trial.x, y, yield_surface.hardening(kappa).value);
          const auto              z = newton({trial.x, y, kappa, (trial.y - y) / g.y}, trial, false);
          if (z && z->multiplier >= 0)
            return z;
        }
    return std::nullopt;
  }

  std::optional<PlasticReturn> ReturnMapping::regular(const PlasticTrial &trial) const
  {
    std::optional<Unknowns> z;
    if (trial.kappa >= 1)
      z = at_strength(trial);
    else
      {
        z = newton({trial.x, trial.y, trial.kappa, 0}, trial, false);
        if (!z || z->multiplier < 0)
          z = nested(trial);
        if (!z || z->multiplier < 0)
          z = from_other_starts(trial);
      }
    if (!z || z->multiplier < 0 || z->y < 0 || z->kappa < trial.kappa)
      return std::nullopt;

    // Implicit function theorem on the four equations.
    const System     s = equations(*z, trial);
    const double     q = yield_surface.hardening(z->kappa).value;
    const LodeRadius r = yield_surface.lode_radius(trial.theta);

    Eigen::Matrix4d by_trial         = Eigen::Matrix4d::Zero(); // d residual / d (x, y, theta, kappa) of the trial
    by_trial(0, 0)                   = -1;
    by_trial(1, 1)                   = -1;
    by_trial(2, 2)                   = -(z->kappa - trial.kappa) * 2 * std::tan(trial.theta);
    by_trial(2, 3)                   = 1;
    by_trial(3, 2)                   = yield_surface.yield_and_derivatives(z->x, z->y, r.value, q).r * r.slope;
    const Eigen::Matrix4d by_unknown = -s.jacobian.partialPivLu().solve(by_trial);
    return PlasticReturn{z->x, z->y, z->kappa, ReturnKind::regular, by_unknown.topRows<3>()};
  }

  ReturnMapping::VertexKappa ReturnMapping::vertex_kappa(const double x, const PlasticTrial &t, const double cone) const
  {
    // (3.2), strains in units of f_c / 2G.
    const double    volumetric = (t.x - x) / bulk_over_shear;
    const double    norm       = std::sqrt(vertex_norm * volumetric * volumetric + t.y * t.y);
    const Ductility h          = yield_surface.ductility(x);
    const double    scale      = strain_unit / h.value;

    // Weight of the Lode angle: 0 on the axis, 1 outside the cone, with a continuous slope.
    const double distance = std::fabs(t.x - x);
    const double s        = t.y < cone * distance ? t.y / (cone * distance) : 1.0;
    const double weight = s * s * (3 - 2 * s), weight_s = 6 * s * (1 - s);
    const double lode = lode_factor(t.theta), on_axis = lode_factor(0.0);
    const double factor   = on_axis + (lode - on_axis) * weight;
    const double factor_y = s < 1 ? (lode - on_axis) * weight_s / (cone * distance) : 0.0;
    const double factor_x = s < 1 ? -(lode - on_axis) * weight_s * s / (t.x - x) : 0.0; // with t.x; -this with x

    VertexKappa  k;
    const double norm_x = norm > 0 ? vertex_norm * volumetric / (norm * bulk_over_shear) : 0.0;
    k.value             = t.kappa + scale * norm * factor;
    k.trial_x           = scale * (norm_x * factor + norm * factor_x);
    k.trial_y           = scale * ((norm > 0 ? t.y / norm : 0.0) * factor + norm * factor_y);
    k.theta             = -scale * norm * weight * 2 * lode * std::tan(t.theta);
    k.x                 = -k.trial_x - (k.value - t.kappa) * h.slope / h.value;
    return k;
  }

  std::optional<double> ReturnMapping::vertex_bracket_end(const PlasticTrial &t) const
  {
    const bool hardened = t.kappa >= 1;
    if (hardened ? t.x > 1 / yield_surface.friction() : t.x > 0)
      return -0.1 * tensile_ratio;
    if (hardened || t.x >= 0)
      return std::nullopt;
    // Compressive apex: the negative root on the axis; the yield function is negative at zero.
    const double q    = yield_surface.hardening(t.kappa).value;
    const auto   apex = bracketed_root([&](const double x) { return yield_surface.yield(x, 0, 1, q); }, t.x, 0.0);
    return apex;
  }

  std::optional<PlasticReturn> ReturnMapping::vertex(const PlasticTrial &t, const double cone) const
  {
    const auto end = vertex_bracket_end(t);
    if (!end)
      return std::nullopt;
    const auto on_axis = [&](const double x) {
      return yield_surface.yield(x, 0, 1, yield_surface.hardening(vertex_kappa(x, t, cone).value).value);
    };
    const auto x = bracketed_root(on_axis, t.x, *end);
    if (!x || *x == t.x)
      return std::nullopt;
    const double            q       = yield_surface.hardening(vertex_kappa(*x, t, cone).value).value;
    const PotentialGradient g       = yield_surface.potential(*x, 0, q);
    const double            allowed = g.y / g.x / bulk_over_shear;
    const double            wanted  = t.y / (t.x - *x);
    if (t.x > *x ? allowed < wanted : allowed > wanted)
      return std::nullopt;
    return vertex_result(*x, t, cone);
  }

  PlasticReturn ReturnMapping::vertex_result(const double x, const PlasticTrial &t, const double cone) const
  {
    const VertexKappa kappa   = vertex_kappa(x, t, cone);
    const Hardening   q       = yield_surface.hardening(kappa.value);
    const YieldValue  f       = yield_surface.yield_and_derivatives(x, 0, 1, q.value);
    const double      f_kappa = f.q * q.slope;

    PlasticReturn            result{x, 0, kappa.value, ReturnKind::vertex, Eigen::Matrix<double, 3, 4>::Zero()};
    const Eigen::RowVector4d kappa_by_trial(kappa.trial_x, kappa.trial_y, kappa.theta, 1);
    result.sensitivity.row(0) = -f_kappa / (f.x + f_kappa * kappa.x) * kappa_by_trial;
    result.sensitivity.row(2) = kappa_by_trial + kappa.x * result.sensitivity.row(0);
    return result;
  }
}
