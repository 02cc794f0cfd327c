#pragma once

#include "base/voigt.h"
#include "dem/core/uniform_random.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/model/packing.h"
#include "dem/network/elastic_network.h"
#include "dem/packing/sequential_placement.h"

#include <Eigen/Geometry>

#include <cmath>

namespace homogenisation_fixture
{
  using Matrix6 = dem::MacroscopicStiffness;

  inline dem::NetworkParameters
  links(const double interaction_ratio, const double shear_ratio, const double modulus = 1)
  {
    dem::NetworkParameters p;
    p.interaction_ratio = interaction_ratio;
    p.normal_modulus    = modulus;
    p.shear_ratio       = shear_ratio;
    return p;
  }

  inline dem::NetworkParameters plane_links(const double interaction_ratio,
                                            const double shear_ratio,
                                            const double thickness,
                                            const double modulus = 1)
  {
    dem::NetworkParameters p = links(interaction_ratio, shear_ratio, modulus);
    p.dimension              = 2;
    p.thickness              = thickness;
    return p;
  }

  /** doc/theory/homogenisation.md, 5. */
  inline dem::Packing eight_particles()
  {
    dem::Packing p;
    p.centre = {{0.625, 0.897, 0.776}, {0.225, 0.300, 0.874}, {0.468, 0.303, 0.278}, {0.036, 0.515, 0.466},
                {0.508, 0.871, 0.361}, {0.123, 0.967, 0.658}, {0.815, 0.730, 0.113}, {0.921, 0.123, 0.092}};
    p.radius.assign(8, 0.22);
    p.periodic_cell = Eigen::Vector3d(1, 1, 1);
    return p;
  }

  /** doc/theory/homogenisation.md, 5. */
  inline dem::Packing six_discs()
  {
    dem::Packing p;
    p.centre = {{0.10, 0.20, 0}, {0.55, 0.15, 0}, {0.30, 0.55, 0}, {0.80, 0.60, 0}, {0.05, 0.85, 0}, {0.60, 0.90, 0}};
    p.radius.assign(6, 0.22);
    p.periodic_cell = Eigen::Vector3d(1, 1, 1);
    return p;
  }

  /** Spheres dropped at random, 33 % solid: with links up to 1.6 diameters a rough but well connected network. */
  inline dem::Packing random_spheres(const std::size_t count, const std::uint64_t seed)
  {
    return dem::place_sequentially(
      count, 1.0, Eigen::Vector3d::Constant(std::cbrt(static_cast<double>(count) * 4.0 / 3 * M_PI / 0.33)), seed);
  }

  /** Rotation of a strain with engineering shears by the rotation R, as a matrix; from the tensor, entry by entry. */
  inline Matrix6 strain_rotation(const Eigen::Matrix3d &R)
  {
    Matrix6 T;
    for (int c = 0; c < 6; ++c)
      {
        const Eigen::Matrix3d E = R * base::strain_tensor(base::Vector6::Unit(c)) * R.transpose();
        T.col(c) << E(0, 0), E(1, 1), E(2, 2), 2 * E(1, 2), 2 * E(2, 0), 2 * E(0, 1);
      }
    return T;
  }

  inline double relative_difference(const Matrix6 &a, const Matrix6 &b) { return (a - b).norm() / b.norm(); }
} // namespace homogenisation_fixture
