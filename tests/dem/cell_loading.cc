#include "base/errors.h"
#include "dem/measures/localisation.h"
#include "periodic_cell_fixture.h"

#include <catch2/catch.hpp>

using namespace periodic_fixture;
using Catch::Contains;

namespace
{
  dem::CellLeg mixed_leg(const double duration, const std::array<bool, 6> &stress_given, const base::Vector6 &target)
  {
    dem::CellLeg leg;
    leg.duration     = duration;
    leg.stress_given = stress_given;
    leg.target       = target;
    return leg;
  }
} // namespace

TEST_CASE("the servo reaches six given stresses at the strains of the static stiffness", "[dem][periodic]")
{
  dem::Specimen specimen(eight_spheres(), elastic(1.5), unit_links(0.2));
  base::Vector6 wanted;
  wanted << 3e-6, -2e-6, 1e-6, 0.5e-6, -1e-6, 0.7e-6;
  dem::CellTestParameters   p;
  const std::array<bool, 6> all = {{true, true, true, true, true, true}};
  const double              dt  = specimen.time_step();
  p.path                        = {mixed_leg(1000 * dt, all, wanted), mixed_leg(9000 * dt, all, wanted)};
  dem::CellTest         test(specimen, p);
  const dem::CellSample end = test.advance(10000);
  REQUIRE(test.finished());
  const base::Vector6 exact = eight_spheres_stiffness().inverse() * wanted;
  CHECK(end.servo_error < 1e-9 * wanted.norm());
  // Finite strain: some 5e-6 of itself.
  CHECK((end.strain - exact).norm() < 5e-5 * exact.norm());
  CHECK(end.skew_stress < 1e-8 * wanted.norm());
}

TEST_CASE("uniaxial stress: one strain and five stresses give the static compliance", "[dem][periodic]")
{
  dem::Specimen             specimen(eight_spheres(), elastic(1.5), unit_links(0.2));
  const base::Matrix6       compliance = eight_spheres_stiffness().inverse();
  dem::CellTestParameters   p;
  const double              dt = specimen.time_step(), strain = 1e-6;
  const std::array<bool, 6> others = {{true, true, false, true, true, true}};
  p.path                           = {mixed_leg(1000 * dt, others, strain * base::Vector6::Unit(2)),
                                      mixed_leg(9000 * dt, others, strain * base::Vector6::Unit(2))};
  dem::CellTest test(specimen, p);
  double        worst = 0;
  while (!test.finished())
    worst = std::max(worst, test.advance(100).servo_error);
  const dem::CellSample end = test.curve().back();
  CHECK(end.stress[2] == Approx(strain / compliance(2, 2)).epsilon(2e-5));
  for (const int c : {0, 1, 3, 4, 5})
    {
      CHECK(std::abs(end.stress[c]) < 1e-9 * end.stress[2]);
      CHECK(end.strain[c] == Approx(strain * compliance(c, 2) / compliance(2, 2)).epsilon(1e-4));
    }
  CHECK(worst < 0.1 * end.stress[2]); // underway too: the ramp lasts some 15 crossing times
}

TEST_CASE("discs: one strain and two stresses in the plane", "[dem][periodic]")
{
  dem::Specimen   specimen(six_discs(), elastic(1.25, 2), unit_links(0.2));
  Eigen::Matrix3d stiffness;
  stiffness << 0.829303, 0.298229, -0.033431, 0.298229, 0.968785, -0.022261, -0.033431, -0.022261, 0.259156;
  const Eigen::Matrix3d     compliance = stiffness.inverse();
  const std::array<bool, 6> others     = {{false, true, false, false, false, true}};
  dem::CellTestParameters   p;
  const double              dt = specimen.time_step();
  p.path                       = {mixed_leg(1000 * dt, others, 1e-6 * base::Vector6::Unit(0)),
                                  mixed_leg(9000 * dt, others, 1e-6 * base::Vector6::Unit(0))};
  dem::CellTest         test(specimen, p);
  const dem::CellSample end = test.advance(10000);
  CHECK(end.stress[0] == Approx(1e-6 / compliance(0, 0)).epsilon(2e-5));
  CHECK(end.strain[1] == Approx(1e-6 * compliance(1, 0) / compliance(0, 0)).epsilon(1e-4));
}

TEST_CASE("a path of legs goes from where it is to each target in turn", "[dem][periodic]")
{
  dem::Specimen           specimen(eight_spheres(), elastic(1.5), unit_links(0.2));
  dem::CellTestParameters p;
  const double            dt = specimen.time_step();
  base::Vector6           a, b;
  a << 1e-4, 0, -2e-4, 0, 3e-4, 0;
  b << -1e-4, 2e-4, 0, 1e-4, 0, 0;
  p.path = {strain_leg(10 * dt, a), strain_leg(20 * dt, b)};
  dem::CellTest test(specimen, p);
  // Sample k is taken at t_n, the start of the last step: one step of strain behind.
  CHECK((test.advance(6).strain - 0.5 * a).norm() < 1e-15);
  CHECK((test.advance(5).strain - a).norm() < 1e-15);
  CHECK((test.advance(5).strain - (0.75 * a + 0.25 * b)).norm() < 1e-15);
  CHECK_FALSE(test.finished());
  test.advance(1000);
  CHECK(test.finished());
  CHECK(specimen.steps() == 30);
  specimen.advance(10); // and then the cell stands still
  CHECK((specimen.cell().deformation - Eigen::Matrix3d::Identity())(0, 0) == Approx(-1e-4));
}

TEST_CASE("a stress that the cell cannot carry stops the run and is named", "[dem][periodic]")
{
  dem::Specimen           specimen(disordered(4, 1), concrete_specimen(), brittle_concrete());
  dem::CellTestParameters p;
  const double            dt = specimen.time_step();
  p.path = {mixed_leg(2000 * dt, {{true, false, false, false, false, false}}, 50e6 * base::Vector6::Unit(0)),
            mixed_leg(1e6 * dt, {{true, false, false, false, false, false}}, 50e6 * base::Vector6::Unit(0))};
  dem::CellTest test(specimen, p);
  REQUIRE_THROWS_WITH(test.advance(100000), Contains("stress 11") && Contains("cannot carry"));
}

TEST_CASE("cell paths that have no meaning are refused", "[dem][periodic]")
{
  dem::Specimen specimen(eight_spheres(), elastic(1.5), unit_links(0.2)),
    plane(six_discs(), elastic(1.25, 2), unit_links(0.2));
  dem::CellTestParameters p;
  REQUIRE_THROWS_WITH(dem::CellTest(specimen, p), Contains("at least one leg"));
  p.path = {strain_leg(0, base::Vector6::Zero())};
  REQUIRE_THROWS_WITH(dem::CellTest(specimen, p), Contains("leg 1") && Contains("duration"));
  p.path = {strain_leg(1, base::Vector6::Constant(std::nan("")))};
  REQUIRE_THROWS_WITH(dem::CellTest(specimen, p), Contains("finite"));
  p.path = {strain_leg(1, 1e-3 * base::Vector6::Unit(3))};
  REQUIRE_THROWS_WITH(dem::CellTest(plane, p), Contains("component 23") && Contains("two dimensions"));
  p.servo_time = 0;
  REQUIRE_THROWS_WITH(dem::CellTest(specimen, p), Contains("servo time"));
}

TEST_CASE("a band of weights is found where it was put, also across the boundary of a sheared cell", "[dem][measures]")
{
  Eigen::Matrix3d base;
  base << 2, 0.3, 0, 0, 3, 0.2, 0, 0, 2.5;
  dem::UniformRandom           random(5);
  std::vector<Eigen::Vector3d> places;
  std::vector<double>          even, banded;
  const double                 width = 0.2, middle = 0.95; // of the period along k = (1, 1, 0), wraps around
  for (int i = 0; i < 20000; ++i)
    {
      const Eigen::Vector3d s(random(), random(), random());
      const double          phase = s[0] + s[1] - middle, off = phase - std::round(phase);
      places.push_back(base * s);
      even.push_back(1.0);
      banded.push_back(std::abs(off) < width / 2 ? 1.0 : 0.0);
    }
  const dem::Band none = dem::strongest_band(base, places, even);
  CHECK(none.concentration < 0.03); // 3/sqrt(20000) for the largest of 13
  CHECK(none.by_chance > 1e-3);
  CHECK(none.participation == Approx(1.0));

  const dem::Band       found      = dem::strongest_band(base, places, banded);
  const Eigen::Vector3d reciprocal = base.inverse().transpose() * Eigen::Vector3d(1, 1, 0);
  CHECK(found.wave == std::array<int, 3>{1, 1, 0});
  CHECK((found.normal - reciprocal.normalized()).norm() < 1e-12);
  CHECK(found.period == Approx(1 / reciprocal.norm()));
  CHECK(found.concentration == Approx(std::sin(M_PI * width) / (M_PI * width)).margin(0.01));
  CHECK(found.place == Approx(middle).margin(0.01));
  CHECK(found.thickness == Approx(width * found.period).epsilon(0.03));
  CHECK(found.participation == Approx(width).epsilon(0.05));
  CHECK(found.by_chance < 1e-100);
  CHECK(dem::strongest_band(base, places, std::vector<double>(20000, 0.0)).concentration == 0);
  REQUIRE_THROWS_AS(dem::strongest_band(base, places, {1.0}), std::invalid_argument);
}
