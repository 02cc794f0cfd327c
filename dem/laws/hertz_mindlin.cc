#include "dem/laws/hertz_mindlin.h"

#include "base/errors.h"
#include "dem/kernels/link_update.h"
#include "dem/laws/requirements.h"

#include <cmath>

namespace dem
{
  namespace
  {
    constexpr Requirements require("hertz-mindlin");

    double normal_modulus(const HertzMindlinParameters &p)
    {
      return p.young_modulus / (2 * (1 - p.poisson_ratio * p.poisson_ratio));
    }
    double shear_modulus(const HertzMindlinParameters &p)
    {
      return p.young_modulus / (4 * (2 - p.poisson_ratio) * (1 + p.poisson_ratio));
    }

    /** The exact relation of Antypov and Elliott (2011), eq. (17): gamma = sqrt(10/3) zeta. */
    double viscosity_for(const double restitution)
    {
      return restitution == 1 ? 0.0 : std::sqrt(10.0 / 3.0) * damping_ratio_of(restitution);
    }
  } // namespace

  HertzMindlinConstants::HertzMindlinConstants(const HertzMindlinParameters &p)
    : HertzMindlinNumbers{normal_modulus(p), shear_modulus(p), p.friction_coefficient, viscosity_for(p.restitution)}
  {
    require(p.young_modulus > 0, "Young modulus", p.young_modulus, "must be above 0 Pa.");
    require(p.poisson_ratio > -1 && p.poisson_ratio <= 0.5, "Poisson ratio", p.poisson_ratio, "must be in (-1, 0.5].");
    require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
    require(p.restitution >= smallest_restitution && p.restitution <= 1, "Restitution", p.restitution,
            "must be in [0.001, 1].");
  }

  base::Matrix6 HertzMindlin::tangent(const Constants        &k,
                                      const LinkStep         &step,
                                      const State<double, 3> &before,
                                      const State<double, 3> &after,
                                      const LinkTangent       kind)
  {
    const LinkGeometry    now    = step.geometry;
    const Eigen::Vector3d n      = step.direction;
    const Eigen::Matrix3d nn     = n * n.transpose();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - nn;
    LinkGeometry          then   = now;
    then.strain                  = step.strain_before;
    const LinkStiffnesses at_end = stiffness(k, now, after), at_start = stiffness(k, then, before);
    base::Matrix6         all   = base::Matrix6::Zero();
    auto                  force = all.topLeftCorner<3, 3>();
    if (kind.secant)
      {
        // Steers an iteration: definite also where nothing touches, as stiff then as at a hundredth of the radius.
        LinkGeometry closed         = now;
        closed.strain               = std::min(now.strain, -0.01 * after.number[effective_radius] / now.reference);
        const LinkStiffnesses least = stiffness(k, closed, after);
        const double          part  = now.strain < 0 ? 1.0 : 1e-6;
        force                       = part * (least.normal * nn + least.shear * across);
        return all;
      }
    if (!(now.strain < 0))
      return all;
    force = at_end.normal * nn;
    Eigen::Vector3d trial;
    const double    kept = at_end.shear > at_start.shear ? at_start.shear / at_end.shear : 1.0;
    for (int c = 0; c < 3; ++c)
      trial[c] = kept * before.shear[0][c] + 0.5 * (1 + kept) * step.shear_increment[c];
    const bool slides = kind.slides && !trial.isZero(0);
    // F_s = k_before old + (k_before + k)/2 increment while the contact grows, k (old + increment) while it shrinks; dk/dd = k/(2 d).
    const Eigen::Vector3d moved      = kept < 1 ? Eigen::Vector3d(0.5 * step.shear_increment) : trial;
    const Eigen::Vector3d by_overlap = at_end.shear / (2 * now.strain) * moved;
    if (!slides)
      {
        force += 0.5 * (1 + kept) * at_end.shear * across + by_overlap * n.transpose();
        return all;
      }
    const Eigen::Vector3d t     = trial.normalized();
    const double          limit = -k.friction * 2.0 / 3.0 * at_end.normal * now.strain;
    force -= k.friction * at_end.normal * t * n.transpose();
    force += limit / (at_end.shear * trial.norm()) * (across - t * t.transpose()) *
             (0.5 * (1 + kept) * at_end.shear * across + by_overlap * n.transpose());
    return all;
  }

  HertzMindlinParameters HertzMindlinLaw::mean_of(const Material<HertzMindlinParameters> &one,
                                                  const Material<HertzMindlinParameters> &other)
  {
    const HertzMindlinParameters &a = one.parameters, &b = other.parameters;
    HertzMindlinParameters        between;
    between.friction_coefficient = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.restitution          = mean(a.restitution, b.restitution);
    if (a.young_modulus == b.young_modulus && a.poisson_ratio == b.poisson_ratio)
      {
        between.young_modulus = a.young_modulus;
        between.poisson_ratio = a.poisson_ratio;
        return between;
      }
    // Two equal bodies with these E* and G*: E*/G* = 2 (2 - nu)/(1 - nu).
    const auto   in_series = [](const double x, const double y) { return 2 * x * y / (x + y); };
    const double normal    = in_series(normal_modulus(a), normal_modulus(b)),
                 shear = in_series(shear_modulus(a), shear_modulus(b)), ratio = normal / (2 * shear);
    between.poisson_ratio = (ratio - 2) / (ratio - 1);
    between.young_modulus = 2 * normal * (1 - between.poisson_ratio * between.poisson_ratio);
    return between;
  }

  std::shared_ptr<const LinkLaw> HertzMindlinLaw::contacts(const std::vector<HertzMindlinParameters> &pairs,
                                                           const Physics                             &physics,
                                                           const int                                  vector_dimension)
  {
    std::vector<HertzMindlinConstants> constants(pairs.begin(), pairs.end());
    if (!physics.friction)
      for (auto &k : constants)
        k.friction = std::numeric_limits<double>::max(); // sticks for ever: shear stays elastic
    return std::make_shared<LinkLawOf<HertzMindlin>>(std::move(constants), vector_dimension, physics.rotations);
  }
} // namespace dem
