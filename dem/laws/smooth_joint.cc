#include "dem/laws/smooth_joint.h"

#include "base/errors.h"
#include "dem/kernels/link_update.h"
#include "dem/laws/requirements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dem
{
  namespace
  {
    constexpr double pi_over_180 = 3.14159265358979323846 / 180;

    constexpr Requirements of_smooth_joint("smooth-joint");
  } // namespace

  SmoothJointConstants::SmoothJointConstants(const SmoothJointParameters &p)
  {
    const auto  &require = of_smooth_joint;
    const double tan_psi = std::tan(p.dilation_angle * pi_over_180);
    require(p.normal_stiffness > 0, "Normal stiffness", p.normal_stiffness, "must be above 0 Pa/m.");
    require(p.shear_stiffness > 0, "Shear stiffness", p.shear_stiffness, "must be above 0 Pa/m.");
    require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
    require(p.dilation_angle >= 0 && p.dilation_angle < 90, "Dilation angle", p.dilation_angle,
            "must lie in [0, 90) degrees.");
    require(tan_psi <= p.friction_coefficient * (1 + 1e-12), "Dilation angle", p.dilation_angle,
            "must not be above the angle of friction: sliding would yield energy.");
    require.strength("Tensile strength", p.tensile_strength);
    require.strength("Cohesion", p.cohesion);
    if (!(std::abs(p.plane.norm() - 1) < 1e-9))
      throw std::logic_error("smooth joint: its normal is no unit vector");
    normal           = p.normal_stiffness;
    shear            = p.shear_stiffness;
    friction         = p.friction_coefficient;
    bond_friction    = p.friction_coefficient;
    dilation         = tan_psi;
    tensile_strength = p.tensile_strength;
    cohesion         = p.cohesion;
    std::copy_n(p.plane.data(), 3, plane);
  }

  void SmoothJoint::begin(const Constants &k, const NewLink &link, double *history)
  {
    const Eigen::Vector3d N(k.plane);
    history[smooth_joint::mode]   = k.tensile_strength > 0 || k.cohesion > 0 ? 0 : 3;
    history[smooth_joint::cosine] = std::min(std::max(N.dot(link.direction), -1.0), 1.0);
  }

  base::Matrix6 SmoothJoint::tangent(const Constants        &k,
                                     const LinkStep         &step,
                                     const State<double, 3> &before,
                                     const State<double, 3> &after,
                                     const LinkTangent       kind)
  {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;
    const auto     oriented = smooth_joint::plane_normal<Constants, double, 3>(k, before.number[smooth_joint::cosine]);
    const Vector3d N(oriented.c);
    const Matrix3d nn = N * N.transpose(), in_plane = Matrix3d::Identity() - nn;
    const Vector3d moved =
      step.geometry.reference * ((step.geometry.strain - step.strain_before) * step.direction + step.shear_increment);
    const Vector3d slip   = in_plane * (Vector3d(before.number + smooth_joint::slip) + moved);
    const double   opened = before.number[smooth_joint::opening] + N.dot(moved), size = slip.norm();
    // One that has never been opened nor pressed resists as a closed one: from there a load goes on.
    const bool    bonded = after.number[smooth_joint::mode] < 0.5, closed = bonded || opened <= 0;
    const double  pressed = closed ? k.normal * opened : 0.0;
    base::Matrix6 all     = base::Matrix6::Zero();
    auto          force   = all.topLeftCorner<3, 3>();
    if (kind.secant)
      {
        const double limit = -k.friction * pressed, shear = k.shear * size;
        const double kept = bonded || shear == 0 ? 1.0 : std::min(std::max(limit / shear, 1e-3), 1.0);
        force = step.geometry.reference * ((closed ? 1.0 : 1e-6) * k.normal * nn + kept * k.shear * in_plane);
        return all;
      }
    if (!closed)
      return all;
    if (bonded || !kind.slides || size == 0)
      {
        force = step.geometry.reference * (k.normal * nn + k.shear * in_plane);
        return all;
      }
    const Vector3d along  = slip / size;
    const double   stress = k.normal * (opened - k.dilation * smooth_joint::length_slid(k, pressed, k.shear * size));
    const Vector3d d_length =
      (k.shear * along + k.friction * k.normal * N) / (k.shear + k.friction * k.dilation * k.normal);
    const Vector3d d_stress = k.normal * (N - k.dilation * d_length);
    force                   = step.geometry.reference * ((N - k.friction * along) * d_stress.transpose() -
                                       k.friction * stress / size * (in_plane - along * along.transpose()));
    return all;
  }

  std::shared_ptr<const LinkLaw> SmoothJointLaw::bonds(const std::vector<SmoothJointParameters> &pairs,
                                                       const Physics                            &physics,
                                                       const int                                 vector_dimension)
  {
    std::vector<SmoothJointConstants> constants;
    for (const SmoothJointParameters &p : pairs)
      {
        SmoothJointConstants &added = constants.emplace_back(p);
        if (!physics.damage)
          added.tensile_strength = added.cohesion = std::numeric_limits<double>::infinity();
        if (!physics.friction)
          added.friction = std::numeric_limits<double>::max(); // sticks for ever: shear stays elastic
      }
    return std::make_shared<LinkLawOf<SmoothJoint>>(std::move(constants), vector_dimension, physics.rotations);
  }
} // namespace dem
