#pragma once

#include "dem/core/uniform_random.h"
#include "dem/measures/damage_tensor.h"
#include "dem/measures/loads.h"

#include <Eigen/Geometry>

#include <vector>

/** Random vectors, directions, rotations and load systems in equilibrium for the tests of measures. */
namespace measures_fixture
{
  inline Eigen::Vector3d random_vector(dem::UniformRandom &random)
  {
    Eigen::Vector3d v;
    for (int d = 0; d < 3; ++d)
      v[d] = 2 * random() - 1;
    return v;
  }

  /** Uniform on the sphere: a vector of the unit ball, normalised. */
  inline Eigen::Vector3d random_direction(dem::UniformRandom &random)
  {
    for (;;)
      {
        const Eigen::Vector3d v = random_vector(random);
        if (v.norm() <= 1 && v.norm() > 1e-3)
          return v.normalized();
      }
  }

  inline Eigen::Matrix3d random_turn(dem::UniformRandom &random)
  {
    return Eigen::AngleAxisd(6 * random(), random_direction(random)).toRotationMatrix();
  }

  inline Eigen::Matrix3d random_symmetric(dem::UniformRandom &random)
  {
    Eigen::Matrix3d t;
    for (int d = 0; d < 3; ++d)
      t.col(d) = random_vector(random);
    return 0.5 * (t + t.transpose());
  }

  /** Links with any forces and couples, and the loads that hold their particles in equilibrium. */
  struct Assembly
  {
    std::vector<dem::LinkLoad>     links;
    std::vector<dem::ExternalLoad> loads;
  };

  /** Points joined by links {J, K, contact point, force and couple on J}; equilibrium of each particle gives its load. */
  struct AssemblyLink
  {
    std::size_t     first, second;
    Eigen::Vector3d contact, force, couple;
  };

  inline Assembly assemble(const std::vector<Eigen::Vector3d> &places, const std::vector<AssemblyLink> &links)
  {
    Assembly a;
    for (const auto &x : places)
      a.loads.push_back({x, {0, 0, 0}, {0, 0, 0}});
    for (const auto &l : links)
      {
        const Eigen::Vector3d J = places[l.first], K = places[l.second];
        a.links.push_back({J, K - J, l.contact, l.force, l.couple});
        a.loads[l.first].force -= l.force;
        a.loads[l.second].force += l.force;
        a.loads[l.first].couple -= (l.contact - J).cross(l.force) + l.couple;
        a.loads[l.second].couple += (l.contact - K).cross(l.force) + l.couple;
      }
    return a;
  }

  inline Assembly random_assembly(const std::uint64_t seed, const std::size_t particles, const std::size_t links)
  {
    dem::UniformRandom           random(seed);
    std::vector<Eigen::Vector3d> places;
    for (std::size_t i = 0; i < particles; ++i)
      places.push_back(random_vector(random));
    std::vector<AssemblyLink> made;
    while (made.size() < links)
      {
        const auto J = static_cast<std::size_t>(random() * particles),
                   K = static_cast<std::size_t>(random() * particles);
        if (J != K)
          made.push_back({J, K, random_vector(random), random_vector(random), random_vector(random)});
      }
    return assemble(places, made);
  }
} // namespace measures_fixture
