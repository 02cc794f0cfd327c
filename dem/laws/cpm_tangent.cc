#include "dem/laws/cpm_tangent.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    /** d omega / d kappa past the onset. */
    double damage_rate(const CpmConstants &k, const double kappa)
    {
      if (k.law == DamageLaw::exponential)
        return k.onset / kappa * (1 / kappa + k.inverse_softening) * std::exp((k.onset - kappa) * k.inverse_softening);
      return kappa < k.softening ? k.onset / (kappa * kappa) * k.linear_factor : 0.0;
    }

    double normal_stress(const CpmConstants &k, const CpmUpdate &u)
    {
      return k.E * (u.normal_strain - u.damage * std::max(u.normal_strain, 0.0));
    }

    /** Shear strength c_0 (1 - omega) - sigma_N tan(phi) [Pa], not below zero. */
    double strength(const CpmConstants &k, const CpmUpdate &u)
    {
      const double opening = std::max(u.normal_strain, 0.0);
      return std::max(k.cohesion * (1 - u.damage) - k.friction * k.E * (u.normal_strain - u.damage * opening), 0.0);
    }
    double strength(const CpmExtendedConstants &k, const CpmUpdate &u)
    {
      return CpmExtended<true>::strength(k, u.damage, normal_stress(k, u));
    }

    /** What pressure adds to it. */
    double friction(const CpmConstants &k, const CpmUpdate &) { return k.friction; }
    double friction(const CpmExtendedConstants &k, const CpmUpdate &u)
    {
      const double stress = normal_stress(k, u);
      return k.log_speed > 0 && stress < 0 ? k.friction / (1 - stress / (k.cohesion * k.log_speed)) : k.friction;
    }

    template <typename Constants>
    Eigen::Matrix3d tangent(const Constants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
    {
      const double    opening     = std::max(u.normal_strain, 0.0);
      Eigen::Vector3d damage_gain = Eigen::Vector3d::Zero(); // d omega / d eps
      if (u.grows && u.kappa > 0)
        damage_gain =
          damage_rate(k, u.kappa) / u.kappa * (opening * n + k.shear_weight * k.shear_weight * u.total_shear);
      const double          open   = opening > 0 ? 1 - u.damage : u.closed_slope;
      const Eigen::Vector3d normal = k.E * (open * n - opening * damage_gain); // d sigma_N / d eps

      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
      if (!u.slides)
        return n * normal.transpose() + k.G * across;
      const double trial = k.G * u.trial_shear.norm(), limit = strength(k, u);
      if (limit == 0) // no strength, no stress, whichever way it slides
        return n * normal.transpose();
      const Eigen::Vector3d t          = u.trial_shear.normalized();
      const Eigen::Vector3d limit_gain = -k.cohesion * damage_gain - friction(k, u) * normal;
      return n * normal.transpose() + t * limit_gain.transpose() + limit / trial * k.G * (across - t * t.transpose());
    }

    template <typename Constants>
    Eigen::Matrix3d secant(const Constants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
    {
      const double          trial = k.G * u.trial_shear.norm();
      const double          kept  = trial > 0 ? std::clamp(strength(k, u) / trial, 1e-3, 1.0) : 1.0;
      const double          open  = u.normal_strain > 0 ? std::max(1 - u.damage, 1e-6) : 1.0;
      const Eigen::Matrix3d nn    = n * n.transpose();
      return open * k.E * nn + kept * k.G * (Eigen::Matrix3d::Identity() - nn);
    }
  } // namespace

  Eigen::Matrix3d cpm_tangent(const CpmConstants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
  {
    return tangent(k, n, u);
  }
  Eigen::Matrix3d cpm_tangent(const CpmExtendedConstants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
  {
    return tangent(k, n, u);
  }
  Eigen::Matrix3d cpm_secant(const CpmConstants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
  {
    return secant(k, n, u);
  }
  Eigen::Matrix3d cpm_secant(const CpmExtendedConstants &k, const Eigen::Vector3d &n, const CpmUpdate &u)
  {
    return secant(k, n, u);
  }
} // namespace dem
