#pragma once

#include "coupling/sequential/particle_field.h"
#include "dem/core/uniform_random.h"

#include <functional>

/// Particle fields with known answers.
namespace fields
{
  using TensorOf = std::function<Eigen::Matrix3d(const Eigen::Vector3d &)>;

  inline Eigen::Matrix3d
  symmetric(const double xx, const double yy, const double zz, const double yz, const double zx, const double xy)
  {
    return (Eigen::Matrix3d() << xx, xy, zx, xy, yy, yz, zx, yz, zz).finished();
  }

  /// A box of edge lengths `box` from the origin filled with n^3 particles in a regular grid, each moved at random by up to
  /// `disorder` of their distance.
  inline coupling::ParticleField box(const Eigen::Vector3d &edges,
                                     const Eigen::Vector3i &n,
                                     const double           disorder,
                                     const TensorOf        &stress,
                                     const TensorOf        &damage)
  {
    dem::UniformRandom      random(7);
    coupling::ParticleField field;
    const Eigen::Vector3d   spacing = edges.cwiseQuotient(n.cast<double>());
    for (int i = 0; i < n[0]; ++i)
      for (int j = 0; j < n[1]; ++j)
        for (int k = 0; k < n[2]; ++k)
          {
            Eigen::Vector3d x;
            for (int d = 0; d < 3; ++d)
              x[d] = ((d == 0 ? i : d == 1 ? j : k) + 0.5 + disorder * (random() - 0.5)) * spacing[d];
            field.place.push_back(x);
            field.volume.push_back(spacing.prod());
            field.stress.push_back(stress(x));
            field.damage.push_back(damage(x));
          }
    field.mean_radius = 0.5 * spacing.minCoeff();
    return field;
  }

  inline TensorOf constant(const Eigen::Matrix3d &value)
  {
    return [value](const Eigen::Vector3d &) { return value; };
  }
} // namespace fields
