#pragma once

#include "dem/specimen/specimen.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

/** Two particles of one millimetre, held and driven, with one bond between them. */
namespace held_pair
{
  constexpr double pi = 3.14159265358979323846;
  constexpr double R = 1e-3, thickness = 1;

  constexpr std::array<bool, 6> all = {true, true, true, true, true, true};

  inline dem::SpecimenParameters in(const int dimension)
  {
    dem::SpecimenParameters p = cluster::next_neighbours();
    p.physics.dimension       = dimension;
    p.thickness               = dimension == 2 ? thickness : 0;
    p.density                 = 2500;
    return p;
  }

  /** What laws with bonds have in common, of one mortar. */
  template <typename Parameters>
  Parameters bond_of_mortar()
  {
    Parameters p;
    p.effective_modulus    = 10.38e9;
    p.stiffness_ratio      = 2.5;
    p.friction_coefficient = 0.21;
    p.tensile_strength     = 0.29e6;
    p.cohesion             = 1.98e6;
    return p;
  }

  inline double section(const int dimension) { return dimension == 2 ? 2 * R * thickness : pi * R * R; }
  inline double second_moment(const int dimension)
  {
    return dimension == 2 ? 2.0 / 3 * thickness * R * R * R : pi * R * R * R * R / 4;
  }

  /** Two touching particles, both held: the second is driven, the first turns against it. */
  struct HeldPair
  {
    HeldPair(const int dimension, const dem::LinkMaterials &law, const double direction_angle = 0)
      : specimen(turned(direction_angle), in(dimension), law)
      , along(std::cos(direction_angle), std::sin(direction_angle), 0)
    {
      for (const std::size_t i : {0, 1})
        {
          dem::Grip grip;
          grip.particles  = {i};
          grip.prescribed = all;
          specimen.grips().add(grip);
        }
    }

    static dem::Packing turned(const double angle)
    {
      dem::Packing packing = cluster::pair_of_spheres(R, R, 2 * R);
      packing.centre[1]    = 2 * R * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      return packing;
    }

    /** Lead the pair so that it would open (slip, bend) by so much in that many steps. */
    void drive(const double opening, const double slip, const double bend, const int steps)
    {
      const double          time = steps * specimen.time_step();
      const Eigen::Vector3d across(-along.y(), along.x(), 0);
      specimen.grips().set_velocity(0, Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 0, -0.5 * bend / time));
      specimen.grips().set_velocity(1, (opening * along + slip * across) / time,
                                    Eigen::Vector3d(0, 0, 0.5 * bend / time));
    }

    double pull() const { return specimen.grips().reaction(1).dot(along); }
    double moment() const { return specimen.grips().reaction_moment(1).z(); }
    double intact() const { return static_cast<double>(specimen.counts().links); }

    dem::Specimen   specimen;
    Eigen::Vector3d along;
  };

  /** Largest pull and moment until the bond breaks. */
  struct Peak
  {
    double pull = 0, moment = 0;
  };

  inline Peak break_it(HeldPair &pair, const int most_steps)
  {
    Peak peak;
    for (int i = 0; i < most_steps && pair.intact() > 0; ++i)
      {
        pair.specimen.advance(1);
        if (pair.intact() > 0)
          peak = {pair.pull(), std::abs(pair.moment())};
      }
    REQUIRE(pair.intact() == 0);
    return peak;
  }

  /** T1: a bond pulled along a direction breaks at sigma_c A, releases what it has stored, and then carries nothing. */
  template <typename Parameters>
  void check_tension(const Parameters &law, const int dimension, const double angle)
  {
    const double  strength = law.tensile_strength * section(dimension);
    const double  opening  = law.tensile_strength * 2 * R / law.effective_modulus;
    HeldPair      pair(dimension, law, angle);
    constexpr int steps = 1000;
    pair.drive(opening, 0, 0, steps);
    pair.specimen.advance(steps / 2 + 1); // forces are those of where the step began
    CHECK(pair.pull() == Approx(0.5 * strength).epsilon(1e-7));
    const Peak peak = break_it(pair, steps + 2);
    CHECK(peak.pull <= strength * (1 + 1e-9));
    CHECK(peak.pull >= strength * (1 - 2.0 / steps));
    CHECK(pair.specimen.counts().broken == 1);
    CHECK(pair.pull() == 0);
    const dem::EnergyAccount energy = pair.specimen.energy();
    CHECK(energy.released == Approx(0.5 * strength * opening).epsilon(3.0 / steps));
    CHECK(energy.balance_error() < 1e-6);
  }
} // namespace held_pair
