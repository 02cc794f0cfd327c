#pragma once

#include "base/matrix6.h"

namespace base
{
  /// Six components in the order xx yy zz yz zx xy. Strains carry engineering shear (gamma = 2 eps), stresses do not.
  using Voigt     = Vector6;
  using Stiffness = Matrix6;

  inline constexpr const char *voigt_names[6] = {"xx", "yy", "zz", "yz", "zx", "xy"};

  /// Unit tensor in Voigt form.
  inline Voigt voigt_identity() { return (Voigt() << 1, 1, 1, 0, 0, 0).finished(); }

  /// Sum of the normal components.
  inline double trace(const Voigt &v) { return v[0] + v[1] + v[2]; }

  /// Symmetric tensor of a stress-like vector (no factor on the shear).
  inline Eigen::Matrix3d stress_tensor(const Voigt &s)
  {
    return (Eigen::Matrix3d() << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]).finished();
  }

  /// Symmetric tensor of a strain-like vector (engineering shear is halved).
  inline Eigen::Matrix3d strain_tensor(const Voigt &e)
  {
    return (Eigen::Matrix3d() << e[0], e[5] / 2, e[4] / 2, e[5] / 2, e[1], e[3] / 2, e[4] / 2, e[3] / 2, e[2])
      .finished();
  }

  /// Strain-like vector of the symmetric part of a tensor.
  inline Voigt strain_voigt(const Eigen::Matrix3d &t)
  {
    return (Voigt() << t(0, 0), t(1, 1), t(2, 2), t(1, 2) + t(2, 1), t(2, 0) + t(0, 2), t(0, 1) + t(1, 0)).finished();
  }

  /// Stress-like vector of the symmetric part of a tensor.
  inline Voigt stress_voigt(const Eigen::Matrix3d &t)
  {
    Voigt s = strain_voigt(t);
    s.tail<3>() *= 0.5;
    return s;
  }

  /// Maps engineering strain to the (stress-like) deviator of its tensor.
  inline Stiffness deviatoric_projector()
  {
    Stiffness p = Stiffness::Zero();
    p.diagonal() << 1, 1, 1, 0.5, 0.5, 0.5;
    p.topLeftCorner<3, 3>().array() -= 1.0 / 3.0;
    return p;
  }

  /// Isotropic stiffness from bulk modulus K [Pa] and shear modulus G [Pa].
  inline Stiffness isotropic_stiffness(const double bulk, const double shear)
  {
    const Voigt one = voigt_identity();
    return bulk * one * one.transpose() + 2 * shear * deviatoric_projector();
  }
}
