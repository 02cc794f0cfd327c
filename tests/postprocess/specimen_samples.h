#pragma once

#include "dem/specimen/specimen.h"

#include <cmath>

namespace postprocess_tests
{
  /** n particles in a row whose every value encodes its particle and its quantity. */
  inline dem::ParticleOutput numbered_particles(const int n)
  {
    dem::ParticleOutput output;
    for (int i = 0; i < n; ++i)
      {
        output.position.emplace_back(i, 0.25, 0.5);
        output.displacement.emplace_back(1e-3 * i, 1e-3 / 3, 0);
        output.velocity.emplace_back(0, i / 7.0, 0);
        output.angular_velocity.emplace_back(0, 0, i / 9.0);
        output.radius.push_back(0.4 + i / 3e3);
        output.damage.push_back(i / double(n));
        output.broken_links.push_back(i % 4);
        Eigen::Matrix3d stress;
        stress << 11 + 100 * i, 12, 13, 12, 22 + 100 * i, 23, 13, 23, 33 + 100 * i;
        output.stress.push_back(stress);
      }
    return output;
  }

  /** Links between neighbours in the row, their kinds in turn. */
  inline dem::LinkOutput numbered_links(const int particles)
  {
    dem::LinkOutput output;
    for (int l = 0; l + 1 < particles; ++l)
      {
        output.ends.push_back({std::size_t(l), std::size_t(l + 1)});
        output.kind.push_back(l % 3);
        output.normal_force.push_back(1 + l / 3.0);
        output.shear_force.push_back(2 + l / 3.0);
        output.normal_stress.push_back(3 + l / 3.0);
        output.shear_stress.push_back(4 + l / 3.0);
        output.normal_strain.push_back(5e-4 + l / 3.0);
        output.damage.push_back(l / double(particles));
      }
    return output;
  }
} // namespace postprocess_tests
