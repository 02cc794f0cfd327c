#pragma once

#include "clusters.h"

#include <cmath>
#include <vector>

/** A body that tears itself apart, and what mechanics says it must keep. */
namespace cluster
{
  /** Momentum and angular momentum of the leap-frog: positions x(n+1) with velocities v(n+1/2). */
  struct Momenta
  {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
    double          linear_scale = 0, angular_scale = 0; ///< sums of the amounts that cancel
  };

  /**
   * The leap-frog keeps sum of x(n) x m v(n+1/2) + I w(n+1/2) exactly: it grows by dt (x(n) x F(n) + T(n)), and both terms of a link
   * cancel since its arms add up to the branch. x(n) x v(n+1/2) is the same with x(n+1), one dt v further.
   */
  inline Momenta momenta(const dem::Specimen &specimen)
  {
    const dem::ParticleOutput out = specimen.particles();
    Momenta                   sum;
    for (std::size_t i = 0; i < out.position.size(); ++i)
      {
        const double          r = out.radius[i], m = specimen.parameters().density * 4.0 / 3.0 * M_PI * r * r * r;
        const Eigen::Vector3d p = m * out.velocity[i], l = out.position[i].cross(p),
                              s = 0.4 * m * r * r * out.angular_velocity[i];
        sum.linear += p;
        sum.angular += l + s;
        sum.linear_scale += p.norm();
        sum.angular_scale += l.norm() + s.norm();
      }
    return sum;
  }

  /** Two clusters of unequal spheres fly at each other off-centre, spinning: links soften, break, slide, and fragments touch. */
  inline dem::Packing colliding_clusters(const std::size_t particles_each)
  {
    dem::Packing       packing = random_cluster(31, particles_each, 0.5e-3, 1e-3);
    const dem::Packing other   = random_cluster(32, particles_each, 0.5e-3, 1e-3);
    double             reach   = 0;
    for (std::size_t i = 0; i < particles_each; ++i)
      reach = std::max({reach, packing.centre[i].norm() + packing.radius[i], other.centre[i].norm() + other.radius[i]});
    for (std::size_t i = 0; i < particles_each; ++i)
      {
        packing.centre.push_back(other.centre[i] + reach * Eigen::Vector3d(1.7, 0.7, 0.1));
        packing.radius.push_back(other.radius[i]);
      }
    return packing;
  }

  inline void set_colliding_velocities(dem::Specimen &specimen, const double speed, const std::uint64_t seed = 33)
  {
    dem::UniformRandom random(seed);
    const std::size_t  n = specimen.counts().particles;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double          towards = i < n / 2 ? 1 : -1;
        const Eigen::Vector3d jitter = 0.2 * speed * random_vector(random), spin = 100 * speed * random_vector(random);
        specimen.set_velocity(i, towards * speed * Eigen::Vector3d::UnitX() + jitter, spin);
      }
  }
} // namespace cluster
