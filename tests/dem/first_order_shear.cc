// The first-order shear update with radii as arms, for comparison with programs that have it (doc/theory/shear-kinematics.md, 3).
#include "base/errors.h"
#include "closed_system.h"
#include "dem/kernels/kinematics.h"
#include "dem/laws/cpm.h"
#include "dem/network/elastic_network.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace
{
  dem::Vec<double, 3> vec(const Vector3d &v) { return {{v[0], v[1], v[2]}}; }

  dem::CpmParameters first_order()
  {
    dem::CpmParameters p = cluster::concrete();
    p.shear_kinematics   = dem::ShearKinematics::first_order;
    return p;
  }

  /** Shear strain that a full turn of a rigid pair about (1, 2, -0.7) leaves. */
  double left_by_full_turn(const int steps)
  {
    const Vector3d      axis     = Vector3d(1, 2, -0.7).normalized();
    const double        angle    = 2 * M_PI / steps;
    dem::Vec<double, 3> shear[1] = {vec(Vector3d::Zero())};
    for (int n = 1; n <= steps; ++n)
      {
        const Vector3d before = Eigen::AngleAxisd(angle * (n - 1), axis) * Vector3d::UnitX(),
                       after  = Eigen::AngleAxisd(angle * n, axis) * Vector3d::UnitX();
        dem::PairMotion<double> m;
        m.branch        = vec(after);
        m.increment     = vec(after - before);
        m.mean_rotation = m.arm_rotation = vec(angle * axis);
        dem::advance_shear_first_order(m, 1.0, 1.0, shear);
      }
    return std::sqrt(dot(shear[0], shear[0]));
  }
} // namespace

TEST_CASE("first-order update strains a link that only turns, by as much as published", "[dem]")
{
  CHECK(left_by_full_turn(100) == Approx(7.8e-2).epsilon(0.01));
  CHECK(left_by_full_turn(1000) == Approx(7.6e-3).epsilon(0.01));
}

TEST_CASE("first-order shear takes the radii as arms, with radii and materials alike or not", "[dem]")
{
  constexpr double v = 1e-3, first_spin = 0.3, second_spin = -0.8;
  for (const double second : {1e-3, 0.6e-3})
    for (const bool two_materials : {false, true})
      {
        CAPTURE(second, two_materials);
        const double first = 1e-3, distance = 1.4 * (first + second);
        dem::Packing pair = cluster::pair_of_spheres(first, second, distance);
        if (two_materials)
          pair.material = {0, 1};
        const dem::CpmMaterials materials =
          two_materials ? dem::CpmMaterials({{"one", first_order(), 0}, {"other", first_order(), 0}}) :
                          dem::CpmMaterials(first_order());
        dem::Specimen specimen(pair, cluster::bonded(1.5), materials);
        specimen.set_velocity(0, Vector3d::Zero(), {0, 0, first_spin});
        specimen.set_velocity(1, {0, v, 0}, {0, 0, second_spin});
        specimen.advance(2); // the second step finds the force of where the first has led to
        const double ratio          = (first + second) / distance,
                     slip           = (ratio * v - first * first_spin - second * second_spin) * specimen.time_step();
        const dem::LinkOutput links = specimen.links();
        REQUIRE(links.ends.size() == 1);
        CHECK(links.load[0].force.y() == Approx(0.2 * 25e9 * M_PI * second * second * slip / distance).epsilon(1e-5));
      }
}

TEST_CASE("first-order shear of equal spheres conserves momentum, and its energy account holds", "[dem]")
{
  omp_set_num_threads(1);
  auto p        = cluster::bonded(1.5);
  p.step_factor = 0.125;
  for (const double speed : {0.01, 2.0}) // elastic; damaging and sliding
    {
      CAPTURE(speed);
      dem::Specimen specimen(cluster::random_cluster(31, 120, 1e-3, 1e-3), p, first_order());
      cluster::set_colliding_velocities(specimen, speed);
      const cluster::Momenta start = cluster::momenta(specimen);
      for (int n = 0; n < 40; ++n)
        {
          specimen.advance(200);
          const cluster::Momenta now = cluster::momenta(specimen);
          CHECK((now.linear - start.linear).norm() < 1e-12 * now.linear_scale);
          CHECK((now.angular - start.angular).norm() < 1e-12 * now.angular_scale);
        }
      const dem::EnergyAccount energy = specimen.energy();
      CAPTURE(energy.initial, energy.elastic, energy.friction, specimen.counts().broken);
      CHECK((energy.friction > 0.01 * energy.initial) == (speed > 1));
      CHECK(energy.balance_error() < 1e-3); // of the step, as with exact shear
    }
}

TEST_CASE("first-order shear is refused where it is not offered", "[dem]")
{
  const auto made = [](const dem::SpecimenParameters &p, const dem::LinkMaterials &materials) {
    return dem::Specimen(cluster::cubic_lattice(2, 2, 1, 1e-3), p, materials);
  };
  dem::SpecimenParameters plane = cluster::next_neighbours();
  plane.physics.dimension       = 2;
  plane.thickness               = 1e-3;
  CHECK_THROWS_WITH(made(plane, first_order()), Contains("Shear kinematics = first-order: not in the plane"));
  dem::SpecimenParameters elastic = cluster::elastic(cluster::next_neighbours());
  CHECK_THROWS_WITH(made(elastic, first_order()), Contains("Shear kinematics = first-order: not without Physics"));
  dem::CpmParameters damaged_by_shear = first_order();
  damaged_by_shear.shear_contribution = 0.5;
  CHECK_THROWS_WITH(made(cluster::next_neighbours(), damaged_by_shear), Contains("not with a Shear contribution"));
  CHECK_THROWS_WITH(dem::mean_of({"soft", first_order(), 0}, {"hard", cluster::concrete(), 0}),
                    Contains("Shear kinematics") && Contains("soft") && Contains("hard"));
  dem::NetworkParameters links;
  links.interaction_ratio = 1.1;
  CHECK_THROWS_WITH(dem::make_network(cluster::cubic_lattice(2, 2, 2, 1e-3), links, first_order()),
                    Contains("Shear kinematics = first-order: only for specimens in motion"));
}
