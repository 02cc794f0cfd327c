#include "dem/laws/linear_contact.h"
#include "dem/packing/frictional_assembly.h"
#include "dem/packing/sequential_placement.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
  /** The cell does not change. */
  double still(double) { return 0; }

  dem::Packing loose(const std::size_t count)
  {
    return dem::place_sequentially(count, 1.0, Eigen::Vector3d::Constant(2.4 * std::cbrt(static_cast<double>(count))),
                                   5);
  }

  /** The same spheres as a specimen in general, the yardstick. */
  dem::Specimen specimen_of(const dem::Packing &packing, const dem::FrictionalAssemblyParameters &p)
  {
    dem::SpecimenParameters general;
    general.physics.damage    = false;
    general.physics.periodic  = true;
    general.density           = 3.0 / (4.0 * M_PI);
    general.interaction_ratio = 1;
    general.damping           = p.damping;
    dem::LinearContactParameters contact;
    contact.effective_modulus    = 2.0 / M_PI;
    contact.stiffness_ratio      = 1 / p.shear_ratio;
    contact.friction_coefficient = p.friction;
    dem::Specimen specimen(packing, general, contact);
    specimen.set_time_step(p.time_step);
    return specimen;
  }
}

TEST_CASE("two spheres pressed together part with the energy that was stored", "[dem][packing]")
{
  // 1/2 k_n s^2 = 1/2 (m/2) v^2: relative speed s sqrt(2). The leap-frog starts with half a step of force missing:
  // relative error of the energy below (w dt/2)^2 = (sqrt(2) 0.01/2)^2 = 5e-5.
  const double overlap = 0.1, time_step = 0.01;
  dem::Packing start;
  start.centre        = {{3.0, 3.0, 3.0}, {3.0 + (2 - overlap) * 0.6, 3.0, 3.0 + (2 - overlap) * 0.8}};
  start.radius        = {1.0, 1.0};
  start.periodic_cell = Eigen::Vector3d(10, 10, 10);
  dem::FrictionalAssembly assembly(start, {0.5, 0.3, 0.0, time_step});
  const auto              distance = [&assembly] { return (assembly.centres()[1] - assembly.centres()[0]).norm(); };
  assembly.advance(400, still); // contact lasts a quarter of the period 2 pi/sqrt(2): 111 steps
  const double before = distance();
  assembly.advance(100, still);
  REQUIRE((distance() - before) / (100 * time_step) == Approx(overlap * std::sqrt(2.0)).epsilon(1e-4));
  const Eigen::Vector3d drift = assembly.centres()[0] + assembly.centres()[1] - start.centre[0] - start.centre[1];
  REQUIRE(drift.norm() < 1e-12); // momentum: rounding of 500 steps
}

TEST_CASE("two spheres that spin alike brake each other by the closed form of a tangential spring", "[dem][packing]")
{
  // While they part from overlap s they touch for T = pi/(2 sqrt 2) (half a mass each on one spring). The slip u grows by
  // L w + the relative motion it causes: u'' = -k_s (2/m + 2 d^2/I) u = -7 k_s u with d = 1, I = 2/5, so that each spin falls
  // by 5/7 of (1 - cos(T sqrt(7 k_s))). Arms d = L/2 differ from 1 by s/2 at most, the step adds its square.
  const double overlap = 1e-5, spin = 1e-6, time_step = 0.001, k_s = 0.3;
  dem::Packing start;
  start.centre                   = {{3.0, 3.0, 3.0}, {3.0 + (2 - overlap) * 0.6, 3.0 + (2 - overlap) * 0.8, 3.0}};
  start.radius                   = {1.0, 1.0};
  start.periodic_cell            = Eigen::Vector3d(10, 10, 10);
  const Eigen::Vector3d axis     = Eigen::Vector3d(-0.8, 0.6, 1.0).normalized(); // perpendicular to the branch
  const double          touching = M_PI / (2 * std::sqrt(2.0));
  const double          sticking = 1 - 5.0 / 7.0 * (1 - std::cos(touching * std::sqrt(7 * k_s)));

  SECTION("sticking when friction is high")
  {
    dem::FrictionalAssembly assembly(start, {1e3, k_s, 0.0, time_step});
    for (const int sphere : {0, 1})
      assembly.set_motion(sphere, Eigen::Vector3d::Zero(), spin * axis);
    assembly.advance(1500, still);
    for (const int sphere : {0, 1})
      REQUIRE((assembly.spin(sphere) / spin - sticking * axis).norm() < 3e-3); // first slip and last step: 2 dt
  }
  SECTION("sliding when friction is low: by the impulse mu s sqrt(m k_n / 2) of the normal force")
  {
    const double            mu = 0.001;
    dem::FrictionalAssembly assembly(start, {mu, k_s, 0.0, time_step});
    for (const int sphere : {0, 1})
      assembly.set_motion(sphere, Eigen::Vector3d::Zero(), spin * axis);
    assembly.advance(1500, still);
    // Torque d mu F_n over I; the contact sticks until k_s u reaches mu s: u = 3e-8 after 2 % of T, less on the way back.
    const double lost = mu * overlap / std::sqrt(2.0) / 0.4;
    for (const int sphere : {0, 1})
      REQUIRE((assembly.spin(sphere) - spin * axis + lost * axis).norm() < 0.03 * lost);
  }
  SECTION("not at all when they turn like gears")
  {
    dem::FrictionalAssembly assembly(start, {1e3, k_s, 0.0, time_step});
    assembly.set_motion(0, Eigen::Vector3d::Zero(), spin * axis);
    assembly.set_motion(1, Eigen::Vector3d::Zero(), -spin * axis);
    assembly.advance(1500, still);
    // Round-off: 4e-16 of positions near 3 in each step, in which the spheres turn by 1e-9.
    REQUIRE((assembly.spin(0) / spin - axis).norm() < 1e-7);
    REQUIRE((assembly.spin(1) / spin + axis).norm() < 1e-7);
  }
}

TEST_CASE("an assembly under compression moves as a specimen of the same contacts does", "[dem][packing]")
{
  // From a loose start to a pressure of 0.05 k_n/r, with sliding, and lists made anew many times. Shear here follows contacts to
  // first order in the step, there exactly: paths part slowly, and pressures are compared before they have.
  const dem::FrictionalAssemblyParameters material{0.5, 0.3, 0.4, 0.02};
  const double                            strain = -1e-4;
  const dem::Packing                      start  = loose(120);
  dem::FrictionalAssembly                 assembly(start, material);
  dem::Specimen                           specimen = specimen_of(start, material);
  specimen.set_velocity_gradient(strain / material.time_step * Eigen::Matrix3d::Identity());
  double highest = 0;
  for (int sample = 0; sample < 26; ++sample)
    {
      assembly.advance(100, [&](double) { return strain; });
      specimen.advance(sample == 0 ? 101 : 100); // whose forces are those before the motion of its last step
      const double pressure = -specimen.cell().stress.trace() / 3;
      highest               = std::max(highest, pressure);
      INFO("look " << sample << ", pressure " << pressure);
      REQUIRE(assembly.measures().pressure == Approx(pressure).epsilon(0.02).margin(1e-5));
    }
  REQUIRE(highest > 0.02);
}

TEST_CASE("an assembly large enough for several threads is the same to the last bit for any number of them",
          "[dem][packing]")
{
  const dem::Packing start  = loose(5000);
  const bool         plates = GENERATE(false, true);
  const auto         after  = [&](const int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    dem::FrictionalAssembly assembly(start, {0.5, 0.3, 0.4, 0.4, plates});
    assembly.advance(150, [](double) { return -1e-3; });
    omp_set_num_threads(before);
    return std::pair(assembly.measures(), assembly.centres());
  };
  const auto [one, centres]  = after(1);
  const auto [three, others] = after(3);
  REQUIRE(one.contacts > 5000);
  REQUIRE(one.pressure == three.pressure);
  REQUIRE(centres == others);
}
