#pragma once

#include "dem/core/uniform_random.h"
#include "dem/laws/cpm.h"
#include "dem/model/packing.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <limits>

/** Small specimens for tests: particles placed by a few lines of arithmetic, a concrete-like link material. */
namespace cluster
{
  /** The concrete of concrete_uniaxial.prm. */
  inline dem::CpmParameters concrete()
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 30;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  /** Links to the next neighbours of a lattice only; every mechanism on. */
  inline dem::SpecimenParameters next_neighbours()
  {
    dem::SpecimenParameters p;
    p.density           = 4800;
    p.interaction_ratio = 1.1;
    return p;
  }

  inline dem::SpecimenParameters bonded(const double interaction_ratio)
  {
    dem::SpecimenParameters p = next_neighbours();
    p.interaction_ratio       = interaction_ratio;
    return p;
  }

  /** Nothing breaks or slides or touches: the undamaged elastic system. */
  inline dem::SpecimenParameters elastic(dem::SpecimenParameters p)
  {
    p.physics.damage = p.physics.friction = p.physics.contacts = false;
    return p;
  }

  inline dem::Packing pair_of_spheres(const double first_radius, const double second_radius, const double distance)
  {
    dem::Packing packing;
    packing.centre = {Eigen::Vector3d::Zero(), Eigen::Vector3d(distance, 0, 0)};
    packing.radius = {first_radius, second_radius};
    return packing;
  }

  /** Simple cubic lattice of touching equal spheres; number (i, j, k) = i + nx (j + ny k). */
  inline dem::Packing cubic_lattice(const int nx, const int ny, const int nz, const double radius)
  {
    dem::Packing packing;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          packing.centre.push_back(2.0 * radius * Eigen::Vector3d(i, j, k));
    packing.radius.assign(packing.centre.size(), radius);
    return packing;
  }

  inline Eigen::Vector3d random_vector(dem::UniformRandom &random)
  {
    const double x = random(), y = random(), z = random(); // in this order on every compiler
    return {2 * x - 1, 2 * y - 1, 2 * z - 1};
  }

  inline Eigen::Vector3d random_direction(dem::UniformRandom &random)
  {
    for (;;)
      {
        const Eigen::Vector3d v = random_vector(random);
        if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1)
          return v.normalized();
      }
  }

  /** Grow a compact random cluster: each sphere touches an earlier one and overlaps none; radii log-uniform between the two. */
  inline dem::Packing
  random_cluster(const std::uint64_t seed, const std::size_t n, const double smallest, const double largest)
  {
    dem::UniformRandom random(seed);
    const auto         radius = [&] { return smallest * std::pow(largest / smallest, random()); };
    dem::Packing       packing;
    packing.centre.push_back(Eigen::Vector3d::Zero());
    packing.radius.push_back(radius());
    while (packing.size() < n)
      {
        const double    r    = radius();
        double          best = std::numeric_limits<double>::infinity();
        Eigen::Vector3d where;
        for (int attempt = 0; attempt < 40; ++attempt)
          {
            const auto            host = static_cast<std::size_t>(random() * static_cast<double>(packing.size()));
            const Eigen::Vector3d x    = packing.centre[host] + (packing.radius[host] + r) * random_direction(random);
            bool                  free = true;
            for (std::size_t i = 0; i < packing.size() && free; ++i)
              free = i == host || (packing.centre[i] - x).norm() >= packing.radius[i] + r;
            if (free && x.norm() < best)
              {
                best  = x.norm();
                where = x;
              }
          }
        if (std::isfinite(best))
          {
            packing.centre.push_back(where);
            packing.radius.push_back(r);
          }
      }
    return packing;
  }

  inline dem::Packing moved(dem::Packing packing, const Eigen::Matrix3d &rotation, const Eigen::Vector3d &shift)
  {
    for (auto &x : packing.centre)
      x = rotation * x + shift;
    return packing;
  }
} // namespace cluster
