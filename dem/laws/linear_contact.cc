#include "dem/laws/linear_contact.h"

#include "base/errors.h"
#include "dem/kernels/link_update.h"
#include "dem/laws/requirements.h"

namespace dem
{
  namespace
  {
    constexpr Requirements require("linear");
  } // namespace

  LinearContactConstants::LinearContactConstants(const LinearContactParameters &p)
    : LinearContactNumbers{p.effective_modulus, p.effective_modulus / p.stiffness_ratio, p.friction_coefficient}
  {
    require(p.effective_modulus > 0, "Effective modulus", p.effective_modulus, "must be above 0 Pa.");
    require(p.stiffness_ratio > 0, "Stiffness ratio", p.stiffness_ratio, "must be above 0.");
    require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
    require(p.restitution >= smallest_restitution && p.restitution <= 1, "Restitution", p.restitution,
            "must be in [0.001, 1].");
    require(p.restitution == 1 || p.normal_force == NormalForce::absolute, "Restitution", p.restitution,
            "must be 1 where Normal force = incremental.");
  }

  DampedContactConstants::DampedContactConstants(const LinearContactParameters &p)
    : LinearContactConstants(p)
    , damping(2 * damping_ratio_of(p.restitution))
  {
  }

  Eigen::Matrix3d linear_contact_tangent(const LinearContactConstants &k,
                                         const Eigen::Vector3d        &n,
                                         const double                  strain,
                                         const Eigen::Vector3d        &trial,
                                         const LinkTangent             kind)
  {
    const Eigen::Matrix3d nn     = n * n.transpose();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - nn;
    const bool            closed = strain < 0;
    const double          size = k.shear * trial.norm(), limit = closed ? -k.friction * k.normal * strain : 0.0;
    if (kind.secant)
      {
        const double kept = size > 0 ? std::min(std::max(limit / size, 1e-3), 1.0) : 1.0;
        return (closed ? 1.0 : 1e-6) * k.normal * nn + kept * k.shear * across;
      }
    if (!closed)
      return Eigen::Matrix3d::Zero();
    if (!kind.slides || size == 0)
      return k.normal * nn + k.shear * across;
    const Eigen::Vector3d t = trial.normalized();
    return k.normal * nn - k.friction * k.normal * t * n.transpose() +
           limit / size * k.shear * (across - t * t.transpose());
  }

  base::Matrix6 LinearContact::tangent(const Constants        &k,
                                       const LinkStep         &step,
                                       const State<double, 3> &before,
                                       const State<double, 3> &,
                                       const LinkTangent kind)
  {
    Eigen::Vector3d trial = step.shear_increment;
    for (int c = 0; c < 3; ++c)
      trial[c] += before.shear[0][c];
    base::Matrix6 all         = base::Matrix6::Zero();
    all.topLeftCorner<3, 3>() = linear_contact_tangent(k, step.direction, step.geometry.strain, trial, kind);
    return all;
  }

  base::Matrix6 IncrementalContact::tangent(const Constants        &k,
                                            const LinkStep         &step,
                                            const State<double, 3> &before,
                                            const State<double, 3> &after,
                                            const LinkTangent       kind)
  {
    Eigen::Vector3d trial = step.shear_increment;
    for (int c = 0; c < 3; ++c)
      trial[c] += before.shear[0][c];
    base::Matrix6 all         = base::Matrix6::Zero();
    all.topLeftCorner<3, 3>() = linear_contact_tangent(k, step.direction, after.number[0], trial, kind);
    return all;
  }

  LinearContactParameters LinearContactLaw::mean_of(const Material<LinearContactParameters> &one,
                                                    const Material<LinearContactParameters> &other)
  {
    const LinearContactParameters &a = one.parameters, &b = other.parameters;
    if (a.normal_force != b.normal_force)
      throw base::InputError("linear/Normal force of the materials " + one.name + " and " + other.name +
                             ": must be the same, absolute or incremental.");
    LinearContactParameters between = a;
    between.effective_modulus       = mean(a.effective_modulus, b.effective_modulus);
    between.stiffness_ratio         = mean(a.stiffness_ratio, b.stiffness_ratio);
    between.friction_coefficient    = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.restitution             = mean(a.restitution, b.restitution);
    return between;
  }

  namespace
  {
    template <typename Law>
    std::shared_ptr<const LinkLaw>
    law_of(const std::vector<LinearContactParameters> &pairs, const Physics &physics, const int vector_dimension)
    {
      std::vector<typename Law::Constants> constants(pairs.begin(), pairs.end());
      if (!physics.friction)
        for (auto &k : constants)
          k.friction = std::numeric_limits<double>::max(); // sticks for ever: shear stays elastic
      return std::make_shared<LinkLawOf<Law>>(std::move(constants), vector_dimension, physics.rotations);
    }
  } // namespace

  std::shared_ptr<const LinkLaw> LinearContactLaw::contacts(const std::vector<LinearContactParameters> &pairs,
                                                            const Physics                              &physics,
                                                            const int vector_dimension)
  {
    if (!pairs.empty() && pairs.front().normal_force == NormalForce::incremental)
      return law_of<IncrementalContact>(pairs, physics, vector_dimension);
    if (std::any_of(pairs.begin(), pairs.end(), [](const auto &pair) { return pair.restitution < 1; }))
      return law_of<DampedContact>(pairs, physics, vector_dimension);
    return law_of<LinearContact>(pairs, physics, vector_dimension);
  }

  // Nothing bonds: links live where particles meet, and the specimen makes none at the start.
  std::shared_ptr<const LinkLaw> LinearContactLaw::bonds(const std::vector<LinearContactParameters> &pairs,
                                                         const Physics                              &physics,
                                                         const int                                   vector_dimension)
  {
    return contacts(pairs, physics, vector_dimension);
  }
} // namespace dem
