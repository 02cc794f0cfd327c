#include "base/errors.h"
#include "dem/laws/linear_contact.h"
#include "dem/measures/localisation.h"
#include "periodic_cell_fixture.h"
#include "tests/dem/memory_state.h"

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
  CHECK(specimen.steps() == 31); // the last one at rest, for the forces of the end
  specimen.advance(10);          // and then the cell stands still
  CHECK((specimen.cell().deformation - Eigen::Matrix3d::Identity())(0, 0) == Approx(-1e-4));
}

TEST_CASE("a stress that the cell cannot carry ends the path and is named", "[dem][periodic]")
{
  dem::Specimen           specimen(disordered(4, 1), concrete_specimen(), brittle_concrete());
  dem::CellTestParameters p;
  const double            dt = specimen.time_step();
  p.path = {mixed_leg(2000 * dt, {{true, false, false, false, false, false}}, 50e6 * base::Vector6::Unit(0)),
            mixed_leg(1e6 * dt, {{true, false, false, false, false, false}}, 50e6 * base::Vector6::Unit(0))};
  dem::CellTest         test(specimen, p);
  const dem::CellSample end = test.advance(100000);
  REQUIRE(test.finished());
  REQUIRE(test.not_reached());
  const dem::StressAtEnd &missed = test.stresses_at_ends().back();
  CHECK(missed.component == 0);
  CHECK(missed.requested > 1e6);
  CHECK(missed.is < 0.5 * missed.requested);
  CHECK(end.strain[0] == Approx(missed.strain).epsilon(1e-12));
  const std::int64_t steps = specimen.steps();
  test.advance(10);
  CHECK(specimen.steps() == steps); // it is over
}

TEST_CASE("a leg of seven steps is recorded to its end", "[dem][periodic]")
{
  dem::Specimen           specimen(lattice({{0, 0, 0}}, 2.0), elastic(1.1), unit_links(0.2));
  dem::CellTestParameters p;
  const double            strain = 1e-6;
  p.path                         = {strain_leg(7 * specimen.time_step(), strain * base::Vector6::Unit(0))};
  dem::CellTest         test(specimen, p);
  const dem::CellSample end = test.advance(100);
  REQUIRE(test.finished());
  CHECK(end.strain[0] == Approx(strain).epsilon(1e-9));
  // doc/theory/homogenisation.md, 5: D11 = (pi/4) E of a cubic lattice of touching spheres.
  CHECK(end.stress[0] == Approx(M_PI / 4 * strain).epsilon(1e-5));
  CHECK(end.time == Approx(7 * specimen.time_step()).epsilon(1e-12));
}

namespace
{
  /** Four spheres of 1 mm that touch along x, with these gaps to their images along y and z [m]. */
  dem::Packing column_of_four(const double gap_y, const double gap_z)
  {
    dem::Packing p;
    for (int i = 0; i < 4; ++i)
      p.centre.emplace_back(2e-3 * i, 0, 0);
    p.radius        = std::vector<double>(4, 1e-3);
    p.periodic_cell = Eigen::Vector3d(8e-3, 2e-3 + gap_y, 2e-3 + gap_z);
    return p;
  }

  dem::CellTestParameters pressed_from_all_sides(const double pressure, const double duration)
  {
    dem::CellTestParameters p;
    base::Vector6           target = base::Vector6::Zero();
    target.head<3>().setConstant(-pressure);
    p.path = {mixed_leg(duration, {{true, true, true, true, true, true}}, target)};
    return p;
  }
} // namespace

TEST_CASE("a cell whose particles do not touch is closed until they bear the prescribed stress", "[dem][periodic]")
{
  const double            E = 25e9, pressure = 1e6, gap_y = 2e-6, gap_z = 5e-6;
  dem::SpecimenParameters how = concrete_specimen();
  how.interaction_ratio       = 1.0001;
  dem::Specimen specimen(column_of_four(gap_y, gap_z), how, brittle_concrete());
  dem::CellTest test(specimen, pressed_from_all_sides(pressure, 30000 * specimen.time_step()));
  CHECK_FALSE(test.holds_together());
  double largest = 0;
  while (!test.finished())
    largest = std::max(largest, -test.advance(10).stress.minCoeff());
  CHECK_FALSE(test.not_reached());
  const dem::CellSample end = test.curve().back();
  for (int c = 0; c < 3; ++c)
    CHECK(end.stress[c] == Approx(-pressure).epsilon(2e-3));
  CHECK(end.stress.tail<3>().cwiseAbs().maxCoeff() < 1e-3 * pressure);
  // Each particle bears the pressure on the sides of its share of the cell, with the section pi r^2 of its contact.
  const double d = 2e-3, hy = d + gap_y, hz = d + gap_z, per_force = 1 / (E * M_PI * d * d / 4);
  CHECK(end.strain[0] == Approx(-pressure * hy * hz * per_force).epsilon(0.01));
  CHECK(end.strain[1] == Approx((d * (1 - pressure * d * hz * per_force) - hy) / hy).epsilon(0.01));
  CHECK(end.strain[2] == Approx((d * (1 - pressure * d * hy * per_force) - hz) / hz).epsilon(0.01));
  CHECK(largest < 1.5 * pressure); // they have not been thrown together
}

TEST_CASE("a leg that is over before particles touch ends the path and names the stress", "[dem][periodic]")
{
  dem::SpecimenParameters how = concrete_specimen();
  how.interaction_ratio       = 1.0001;
  dem::Specimen           specimen(column_of_four(1e-4, 2e-4), how, brittle_concrete());
  dem::CellTestParameters p = pressed_from_all_sides(1e5, 2000 * specimen.time_step());
  p.path.push_back(strain_leg(1000 * specimen.time_step(), -0.01 * base::Vector6::Unit(0)));
  dem::CellTest test(specimen, p);
  test.advance(10000);
  REQUIRE(test.finished());
  REQUIRE(test.not_reached());
  CHECK(specimen.steps() == 2001);
  const dem::StressAtEnd &missed = test.stresses_at_ends().back();
  CHECK(missed.leg == 0);
  CHECK((missed.component == 1 || missed.component == 2));
  CHECK(missed.requested == -1e5);
  CHECK(missed.is == 0);
  CHECK(missed.strain < 0);
  CHECK_FALSE(missed.at_limit);
}

TEST_CASE("a cell that is closed goes on from a saved state to the same bits", "[dem][periodic]")
{
  dem::SpecimenParameters how = concrete_specimen();
  how.interaction_ratio       = 1.0001;
  MemoryState saved, whole;
  const auto  path = [](const dem::Specimen &specimen) {
    return pressed_from_all_sides(1e6, 3000 * specimen.time_step());
  };
  {
    dem::Specimen specimen(column_of_four(2e-7, 5e-7), how, brittle_concrete());
    dem::CellTest test(specimen, path(specimen));
    test.advance(1497);
    REQUIRE(specimen.counts().contacts > 0);
    saved = MemoryState::of(specimen, test);
    test.advance(3000);
    REQUIRE(test.finished());
    whole = MemoryState::of(specimen, test);
  }
  dem::Specimen specimen(column_of_four(2e-7, 5e-7), how, brittle_concrete());
  dem::CellTest test(specimen, path(specimen));
  saved.restore(specimen, test);
  test.advance(3000);
  CHECK(MemoryState::of(specimen, test) == whole);
}

TEST_CASE("grains without contacts have no damage, and no error of their energies", "[dem][periodic]")
{
  dem::LinearContactParameters law;
  law.effective_modulus         = 1e9;
  dem::SpecimenParameters   how = concrete_specimen();
  dem::Specimen             specimen(column_of_four(1e-4, 2e-4), how, law);
  dem::CellTestParameters   p;
  const std::array<bool, 6> all = {{true, true, true, true, true, true}};
  p.path                        = {mixed_leg(200 * specimen.time_step(), all, base::Vector6::Zero())};
  dem::CellTest test(specimen, p);
  while (!test.finished())
    {
      test.advance(10);
      CHECK(specimen.mean_damage() == 0);
      CHECK(specimen.energy().balance_error() < 1e-6);
    }
  CHECK_FALSE(test.not_reached());
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
