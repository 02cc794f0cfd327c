#pragma once

#include "clusters.h"
#include "dem/core/uniform_random.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/flat_joint.h"
#include "dem/packing/lattice.h"

#include <catch2/catch.hpp>

#include <cmath>

/** Crystals and rock-like specimens of discs, and tests that take them to their end. */
namespace laboratory
{
  using Test = dem::LabParameters::Test;

  constexpr double R = 1e-3, modulus = 10e9;

  inline dem::FlatJointParameters strong()
  {
    dem::FlatJointParameters p;
    p.effective_modulus    = modulus;
    p.stiffness_ratio      = 2.5;
    p.friction_coefficient = 0.2;
    p.tensile_strength = p.cohesion = 1e12;
    return p;
  }

  inline dem::FlatJointParameters weak()
  {
    dem::FlatJointParameters p = strong();
    p.tensile_strength         = 2e6;
    p.cohesion                 = 10e6;
    p.friction_angle           = 20;
    return p;
  }

  inline dem::SpecimenParameters discs()
  {
    dem::SpecimenParameters p = cluster::next_neighbours();
    p.physics.dimension       = 2;
    p.thickness               = 1;
    p.density                 = 2500;
    p.damping                 = 0.7;
    return p;
  }

  /** Rows along x. Radii a little unequal make a specimen of it that breaks like rock. */
  inline dem::Packing crystal(const int columns, const int rows, const double unequal = 0)
  {
    dem::Packing       packing = dem::make_lattice(dem::Lattice::hexagonal, R, {columns, rows, 1});
    dem::UniformRandom random(7);
    packing.periodic_cell.reset();
    for (double &r : packing.radius)
      r *= 1 - unequal * random();
    return packing;
  }

  /** A close packing of spheres cut to an upright cylinder, its radii a little unequal. */
  inline dem::Packing cylinder_of_spheres(const double radius, const double height)
  {
    const int             across = static_cast<int>(std::ceil(radius / (std::sqrt(2) * R))) + 1;
    const int             along  = static_cast<int>(std::ceil(height / (2 * std::sqrt(2) * R))) + 1;
    const auto            whole  = dem::make_lattice(dem::Lattice::face_centred_cubic, R, {across, across, along});
    const Eigen::Vector3d middle = 0.5 * *whole.periodic_cell;
    dem::Packing          packing;
    dem::UniformRandom    random(11);
    for (const Eigen::Vector3d &x : whole.centre)
      if ((x - middle).head<2>().norm() <= radius - R && std::abs(x.z() - middle.z()) <= 0.5 * height - R)
        {
          packing.centre.push_back(x);
          packing.radius.push_back(R * (1 - 0.02 * random()));
        }
    return packing;
  }

  inline dem::LabParameters between_platens(const double speed)
  {
    dem::LinearContactParameters platens;
    platens.effective_modulus = modulus;
    dem::LabParameters p;
    p.test          = Test::compression;
    p.press.axis    = 1;
    p.press.contact = platens;
    p.speed         = speed;
    p.stop_strain   = 2e-4;
    return p;
  }

  /** A specimen in a test, driven until it ends. */
  struct Run
  {
    Run(const dem::Packing            &packing,
        const dem::SpecimenParameters &p,
        const dem::LinkMaterials      &law,
        const dem::LabParameters      &requested)
      : body(packing, p, law)
      , test(body, requested)
    {
    }
    void advance(const std::int64_t steps)
    {
      if (test.finished())
        return;
      const auto drive = [this] {
        body.partners().clear_forces();
        test.drive();
      };
      drive();
      body.advance(steps, [&] {
        test.observe();
        drive();
        return !test.finished();
      });
    }
    void to_end(const std::int64_t most)
    {
      advance(most);
      INFO("stress " << test.reading().stress << ", strain " << test.reading().strain << ", stage "
                     << static_cast<int>(test.stage()));
      REQUIRE(test.finished());
    }

    dem::Specimen body;
    dem::LabTest  test;
  };

  inline double crystal_modulus(const double kappa)
  {
    return 2 * std::sqrt(3) * (1 + 1 / kappa) / (3 + 1 / kappa) * modulus;
  }
} // namespace laboratory
