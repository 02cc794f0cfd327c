#pragma once

#include "dem/laws/cpm.h"
#include "dem/model/packing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

/**
 * Links, kinematics and cohesive particle model once more, link by link with matrices as they are printed in the literature
 * (doc/theory/links.md, shear-kinematics.md, cpm.md): slow, and without a line in common with dem.
 */
namespace reference
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  inline Matrix3d rotation(const Vector3d &vector)
  {
    const double angle = vector.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Matrix3d::Identity();
  }

  inline Matrix3d skew(const Vector3d &a)
  {
    Matrix3d m;
    m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    return m;
  }

  /** Minimal rotation of unit vectors, 2.3 step 2. */
  inline Matrix3d minimal(const Vector3d &a, const Vector3d &b)
  {
    const Matrix3d s = skew(a.cross(b));
    return Matrix3d::Identity() + s + s * s / (1 + a.dot(b));
  }

  struct Body
  {
    Vector3d position, displacement = Vector3d::Zero(), turn = Vector3d::Zero(); ///< now, and of the last step
    double   radius;
  };

  struct Link
  {
    std::size_t J, K;
    double      L0, A;
    Vector3d    elastic_shear = Vector3d::Zero(), shear = Vector3d::Zero();
    double      kappa = 0, omega = 0;
    Vector3d    normal = Vector3d::Zero(), force = Vector3d::Zero(); ///< n, force on J
    double      strain = 0, normal_stress = 0, shear_stress = 0;
    Vector3d    moment_J = Vector3d::Zero(), moment_K = Vector3d::Zero();
  };

  struct Model
  {
    dem::CpmParameters p;
    bool               damage = true, friction = true;

    double g(const double kappa) const
    {
      const double e0 = p.limit_elastic_strain, ef = p.relative_ductility * e0;
      if (kappa <= e0)
        return 0;
      if (p.damage_law == dem::DamageLaw::exponential)
        return 1 - e0 / kappa * std::exp(-(kappa - e0) / ef);
      return std::min(1.0, (1 - e0 / kappa) / (1 - e0 / ef));
    }

    void update(Link &c, const Body &J, const Body &K) const
    {
      advance_shear(c, J, K);
      const double E = p.normal_modulus, G = p.shear_ratio * E, e = c.strain, xi = p.shear_contribution;
      if (damage)
        {
          const double opening = std::max(e, 0.0);
          c.kappa              = std::max(c.kappa, std::sqrt(opening * opening + xi * xi * c.shear.squaredNorm()));
          c.omega              = g(c.kappa);
        }
      c.normal_stress = (e > 0 ? 1 - c.omega : 1) * E * e;
      Vector3d     sT = G * c.elastic_shear;
      const double R  = std::max(0.0, p.cohesion * (1 - c.omega) - c.normal_stress * p.friction_coefficient);
      if (friction && sT.norm() > R)
        {
          sT *= R / sT.norm();
          c.elastic_shear = sT / G;
        }
      c.shear_stress         = sT.norm();
      c.force                = c.A * (c.normal_stress * c.normal + sT);
      const double   L       = (K.position - J.position).norm();
      const Vector3d contact = J.position + (J.radius + 0.5 * (L - J.radius - K.radius)) * c.normal;
      c.moment_J             = (contact - J.position).cross(c.force);
      c.moment_K             = -(contact - K.position).cross(c.force);
    }

  private:
    static double tau(const double angle) { return angle > 0 ? std::tan(0.5 * angle) / (0.5 * angle) : 1.0; }

    static void advance_shear(Link &c, const Body &J, const Body &K)
    {
      const Vector3d l1 = K.position - J.position, l0 = l1 - (K.displacement - J.displacement), lm = 0.5 * (l0 + l1);
      const Vector3d n0 = l0.normalized(), n1 = l1.normalized(), nm = lm.normalized();
      const double   L = l1.norm(), d_J = J.radius + 0.5 * (L - J.radius - K.radius), d_K = L - d_J;
      const Matrix3d mean = rotation(0.5 * (J.turn + K.turn)), carry = minimal(mean * n0, n1) * mean;
      Vector3d       du =
        (l1 - l0) - d_J / L * tau(J.turn.norm()) * J.turn.cross(lm) - d_K / L * tau(K.turn.norm()) * K.turn.cross(lm);
      du -= nm * nm.dot(du);
      du = minimal(nm, n1) * du / c.L0;
      for (Vector3d *stored : {&c.elastic_shear, &c.shear})
        {
          *stored = carry * *stored + du;
          *stored -= n1 * n1.dot(*stored);
        }
      c.normal = n1;
      c.strain = (L - c.L0) / c.L0;
    }
  };

  /** Bodies of a packing and the links of an interaction ratio; cross-sections of spheres, or of discs of a thickness. */
  struct Assembly
  {
    std::vector<Body> bodies;
    std::vector<Link> links;

    Assembly(const dem::Packing &packing, const double interaction_ratio, const int dimension, const double thickness)
    {
      for (std::size_t i = 0; i < packing.size(); ++i)
        {
          Body body;
          body.position = packing.centre[i];
          body.radius   = packing.radius[i];
          bodies.push_back(body);
        }
      for (std::size_t J = 0; J < bodies.size(); ++J)
        for (std::size_t K = J + 1; K < bodies.size(); ++K)
          {
            const double L = (packing.centre[K] - packing.centre[J]).norm(),
                         r = std::min(packing.radius[J], packing.radius[K]);
            if (!(L < interaction_ratio * (packing.radius[J] + packing.radius[K])))
              continue;
            Link link;
            link.J  = J;
            link.K  = K;
            link.L0 = L;
            link.A  = dimension == 3 ? M_PI * r * r : 2 * r * thickness;
            links.push_back(link);
          }
    }

    void update(const Model &model)
    {
      for (Link &c : links)
        model.update(c, bodies[c.J], bodies[c.K]);
    }
  };
} // namespace reference
