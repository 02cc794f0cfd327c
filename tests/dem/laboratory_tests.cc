// Tests of a laboratory in the kernel against closed forms: doc/theory/laboratory.md.
#include "dem/core/uniform_random.h"
#include "dem/facets/surface.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/lattice.h"
#include "dem/packing/tiling.h"
#include "laboratory_fixture.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>

using Eigen::Vector3d;
using namespace laboratory;

TEST_CASE("hexagonal crystal between platens has the modulus and Poisson's ratio of the closed form (T8)",
          "[dem][laboratory][slow]")
{
  dem::LabParameters requested = between_platens(0.005);
  Run                run(crystal(61, 31), discs(), strong(), requested);
  run.to_end(200000);
  const dem::TestFigures found = run.test.figures();
  REQUIRE(found.gauge_modulus.found);
  REQUIRE(found.poisson_slope.found);
  CHECK(found.gauge_modulus.value == Approx(crystal_modulus(2.5)).epsilon(0.03));
  CHECK(found.modulus.value == Approx(crystal_modulus(2.5)).epsilon(0.03));
  CHECK(found.secant_modulus.value == Approx(found.modulus.value).epsilon(0.02));
  CHECK(found.poisson_slope.value == Approx(0.176471).margin(0.01));
  CHECK_FALSE(found.strength.found); // it cannot break, and the figures say that they do not know
  CHECK(run.body.energy().balance_error() < 1e-3);
  const dem::QuasiStatic how = run.test.how_static();
  INFO("difference " << how.imbalance.value << ", kinetic " << how.kinetic.value << ", ratio "
                     << how.force_ratio.value);
  CHECK(how.holds());
}

TEST_CASE("crystal pulled by glued platens has the same modulus", "[dem][laboratory][slow]")
{
  dem::LabParameters requested = between_platens(0.02);
  requested.test               = Test::tension;
  requested.press.layer        = 0.5 * R;
  Run run(crystal(41, 31), discs(), strong(), requested);
  run.to_end(200000);
  const dem::TestFigures found = run.test.figures();
  CHECK(found.gauge_modulus.value == Approx(crystal_modulus(2.5)).epsilon(0.03));
  CHECK(found.poisson_slope.value == Approx(0.176471).margin(0.02));
  CHECK(run.body.energy().balance_error() < 1e-3);
}

TEST_CASE("beam of a crystal bends as three-point bending says, with shear", "[dem][laboratory][slow]")
{
  dem::LabParameters requested = between_platens(0.003);
  requested.test               = Test::bending;
  requested.press.along        = 0;
  requested.press.span         = 0.18;
  requested.press.roller       = 4e-3;
  requested.stop_strain        = 1e-4;
  Run run(crystal(100, 6), discs(), strong(), requested);
  run.to_end(400000);
  INFO("stress " << run.test.reading().stress << " strain " << run.test.reading().strain << " steps "
                 << run.body.steps() << " rows " << run.test.record().rows() << " gauge "
                 << run.test.reading().gauge_strain);
  const dem::TestFigures found = run.test.figures();
  REQUIRE(found.gauge_modulus.found);
  // A crystal of flat joints is stiffer in bending by what its joints resist of rotation; shear makes it softer by
  // 1 + 12 E I/(kappa G A L^2) = 1 + 2.4 (1 + nu) (d/L)^2.
  const double deep = (2 + 11 * std::sqrt(3)) * R, ratio = deep / requested.press.span;
  const double E = crystal_modulus(2.5) / (1 + 2.4 * 1.176 * ratio * ratio);
  CHECK(found.gauge_modulus.value == Approx(E).epsilon(0.08));
  CHECK(run.body.energy().balance_error() < 1e-3);
}

TEST_CASE("disk between platens grows wider at its middle as an elastic disk does", "[dem][laboratory][slow]")
{
  const double   D     = 0.08;
  dem::Packing   whole = crystal(66, 40), disk;
  const Vector3d middle(66 * R, 40 * std::sqrt(3) * R, 0);
  for (std::size_t i = 0; i < whole.size(); ++i)
    if ((whole.centre[i] - middle).norm() <= 0.5 * D - R)
      {
        disk.centre.push_back(whole.centre[i]);
        disk.radius.push_back(whole.radius[i]);
      }
  dem::LabParameters requested = between_platens(0.005);
  requested.test               = Test::splitting;
  requested.press.smoothing    = 0.4 * R;
  requested.stop_strain        = 2e-4;
  Run run(disk, discs(), strong(), requested);
  run.to_end(400000);
  // Hondros, Aust. J. Appl. Sci. 10 (1959) 243: pressure p on arcs of half angle a at either platen; on the diameter across the load,
  // r = 2x/D, f = (1 - r^2) sin 2a/(1 + 2 r^2 cos 2a + r^4), g = atan((1 - r^2)/(1 + r^2) tan a): sigma_x = 2p/pi (f - g), sigma_y =
  // -2p/pi (f + g). For a = 0 that is 2P/(pi D t) in the middle. How far two places move apart follows by quadrature.
  const double nu = 0.176471, E = crystal_modulus(2.5);
  const auto   beside = [&](const double side) {
    dem::MeanMotion group;
    for (std::size_t i = 0; i < disk.size(); ++i)
      {
        const Vector3d x = disk.centre[i] - middle;
        if (std::abs(x.y()) < 3 * R && std::abs(x.x() - side * 0.3 * D) < 3 * R)
          group.particles.push_back(i);
      }
    double sum = 0;
    for (const std::size_t i : group.particles)
      sum += (disk.centre[i] - middle).x() / static_cast<double>(group.particles.size());
    group.place = sum;
    return group;
  };
  const auto right = beside(1), left = beside(-1);
  double     half = 0;
  for (const dem::WallContact &touch : run.body.surfaces().contacts())
    half = std::max(half, std::abs((touch.place - middle).x()) + R);
  const double angle = std::asin(2 * half / D), load = 0.5 * (run.test.reading().low + run.test.reading().high);
  const double p = load / (angle * D * 1.0);
  CHECK(angle < 0.3);
  double    sum = 0;
  const int n   = 2000;
  for (int k = 0; k < n; ++k)
    {
      const double x = (k + 0.5) / n * 0.5 * (right.place - left.place), r2 = 4 * x * x / (D * D);
      const double f = (1 - r2) * std::sin(2 * angle) / (1 + 2 * r2 * std::cos(2 * angle) + r2 * r2);
      const double g = std::atan((1 - r2) / (1 + r2) * std::tan(angle));
      sum += 2 * p / M_PI * ((f - g) + nu * (f + g)) / E / n;
    }
  const double strain = (right.along(run.body, 0) - left.along(run.body, 0)) / (right.place - left.place);
  CHECK(strain == Approx(sum).epsilon(0.03));
  CHECK_FALSE(run.test.figures().modulus.found);
  CHECK(run.body.energy().balance_error() < 1e-3);
}

TEST_CASE("what is cut off at platens touches without force until they move", "[dem][laboratory]")
{
  dem::LabParameters requested = between_platens(0.02);
  requested.press.smoothing    = 0.4 * R;
  dem::Packing rough           = crystal(12, 6, 0.1);
  Run          run(rough, discs(), weak(), requested);
  run.body.partners().find_surface_forces();
  CHECK(run.body.surfaces().at(0).total_force.norm() == 0);
  CHECK(run.body.surfaces().at(1).total_force.norm() == 0);
  // Cycling without motion: nothing moves.
  run.body.surfaces().set_motion(0, Vector3d::Zero());
  run.body.surfaces().set_motion(1, Vector3d::Zero());
  run.body.advance(1000);
  double most = 0;
  for (const Vector3d &u : run.body.particles().displacement)
    most = std::max(most, u.norm());
  CHECK(most < 1e-12);
  // A hair's breadth later all that was cut off pushes, not the outermost alone.
  run.advance(500);
  CHECK(run.body.counts().wall_contacts > 12);
  CHECK_THROWS_WITH(run.body.surfaces().cut_off(0), Catch::Contains("before the first step"));
}

TEST_CASE("platens stand where they are placed, and particles that reach through are cut off whatever the depth",
          "[dem][laboratory]")
{
  dem::LabParameters requested = between_platens(0.02);
  dem::Packing       rough     = crystal(12, 6, 0.1);
  const int          axis      = requested.press.axis;
  double             lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t i = 0; i < rough.size(); ++i)
    {
      lowest  = std::min(lowest, rough.centre[i][axis] - rough.radius[i]);
      highest = std::max(highest, rough.centre[i][axis] + rough.radius[i]);
    }
  requested.press.stand = {lowest + 0.3 * R, highest - 0.2 * R};
  dem::Specimen    body(rough, discs(), weak());
  const dem::Press press(body, requested.press);
  CHECK(press.planes().low == lowest + 0.3 * R);
  CHECK(press.planes().high == highest - 0.2 * R);
  CHECK(press.height() == Approx(highest - lowest - 0.5 * R).epsilon(1e-12));
  Run run(rough, discs(), weak(), requested);
  run.body.partners().find_surface_forces();
  CHECK(run.body.surfaces().at(0).total_force.norm() == 0);
  CHECK(run.body.surfaces().at(1).total_force.norm() == 0);
  run.advance(500);
  CHECK(run.body.counts().wall_contacts > 12);
}

TEST_CASE("a specimen that still grows wider is not at rest, whatever its forces", "[dem][laboratory]")
{
  dem::LabParameters requested = between_platens(0.02);
  requested.seating_stress     = 1e3;
  requested.rest               = 1; // any force will do
  Run          run(crystal(12, 8), discs(), strong(), requested);
  const auto   particles = run.body.particles();
  const double middle = dem::BodyExtent(particles).middle(0), rate = 2;
  for (std::size_t i = 0; i < particles.position.size(); ++i)
    run.body.set_velocity(i, Vector3d(rate * (particles.position[i].x() - middle), 0, 0), Vector3d::Zero());
  const double start = run.body.kinetic_energy();
  for (int i = 0; i < 20000 && run.test.stage() != dem::LabTest::Stage::loading; ++i)
    run.advance(1);
  REQUIRE(run.test.stage() == dem::LabTest::Stage::loading);
  CHECK(run.body.kinetic_energy() < 1e-3 * start);
  CHECK(run.test.notes().empty());
}

TEST_CASE("stress is that of the given section, and a disk's that of its diameter across the load", "[dem][laboratory]")
{
  dem::LabParameters requested = between_platens(0.02);
  requested.section            = 0.03;
  CHECK(Run(crystal(12, 6), discs(), strong(), requested).test.stress_of_force() == Approx(1 / 0.03).epsilon(1e-12));
  requested.section.reset();
  const Run    plain(crystal(12, 6), discs(), strong(), requested);
  const double wide = dem::BodyExtent(plain.body.particles()).length(0);
  CHECK(plain.test.stress_of_force() == Approx(1 / wide).epsilon(1e-12));
  requested.test = Test::splitting; // what is loaded here has flats: it is not as high as wide
  CHECK(Run(crystal(12, 6), discs(), strong(), requested).test.stress_of_force() ==
        Approx(2 / (M_PI * wide)).epsilon(1e-12));
}

TEST_CASE("specimen loaded to a tenth of its strength and unloaded is what it was (genesis 7)",
          "[dem][laboratory][slow]")
{
  const auto         packing   = crystal(12, 8, 0.05);
  dem::LabParameters requested = between_platens(0.05);
  requested.stop_strain        = 0.02;
  requested.press.smoothing    = 0.2 * R;
  Run whole(packing, discs(), weak(), requested);
  whole.to_end(400000);
  REQUIRE(whole.test.figures().strength.found);
  const double strength = whole.test.figures().strength.value;

  dem::Specimen        body(packing, discs(), weak());
  dem::PressParameters machine = requested.press;
  dem::Press           press(body, machine);
  const double         per_force = whole.test.stress_of_force();
  const auto           until     = [&](const double speed, const std::function<bool()> &there) {
    for (int i = 0; i < 200000 && !there(); ++i)
      {
        press.move(speed);
        body.advance(1);
      }
    press.move(0);
    body.advance(20000);
  };
  until(0.01, [&] { return press.force(dem::Press::high) * per_force >= 0.1 * strength; });
  CHECK(body.logged_breaks() == 0);
  const double loaded = -press.approach();
  until(-0.01, [&] { return press.approach() <= 0; });
  CHECK(loaded < 0);
  double     most = 0;
  const auto now  = body.particles();
  Vector3d   mean = Vector3d::Zero();
  for (const Vector3d &u : now.displacement)
    mean += u / static_cast<double>(now.displacement.size());
  for (const Vector3d &u : now.displacement)
    most = std::max(most, (u - mean).norm());
  CHECK(most < 1e-6 * std::abs(loaded));
  CHECK(body.energy().elastic < 1e-9 * whole.body.energy().external_work);
  CHECK(body.energy().released == 0);
}

namespace
{
  /** Along y [m]. */
  double height_of(const dem::Packing &packing)
  {
    double low = 1, high = -1;
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        low  = std::min(low, packing.centre[i].y() - packing.radius[i]);
        high = std::max(high, packing.centre[i].y() + packing.radius[i]);
      }
    return high - low;
  }
} // namespace

TEST_CASE("a weak specimen breaks, and its test ends past the peak with figures", "[dem][laboratory][slow]")
{
  dem::LabParameters requested = between_platens(0.1);
  requested.stop_strain        = 0.02;
  requested.seating_stress     = 1e5;
  Run run(crystal(14, 10, 0.05), discs(), weak(), requested);
  run.to_end(400000);
  const dem::TestFigures found = run.test.figures();
  REQUIRE(found.strength.found);
  CHECK(run.test.seated_strain() > 0);
  CHECK(run.body.logged_breaks() > 10);
  CHECK(found.smooth_strength.value <= found.strength.value);
  CHECK(found.smooth_strength.value > 0.9 * found.strength.value);
  CHECK(run.test.reading().stress < 0.7 * found.strength.value);
  CHECK(run.test.stress_left() == Approx(run.test.reading().stress / found.strength.value));
  CHECK(found.modulus.found);
  // What the platens have done is the area under the curve, over the height of the specimen.
  const auto strain = run.test.record().values(dem::TestRecord::strain),
             stress = run.test.record().values(dem::TestRecord::stress);
  double below      = 0.5 * stress.front() * strain.front();
  for (std::size_t row = 1; row < strain.size(); ++row)
    below += 0.5 * (stress[row] + stress[row - 1]) * (strain[row] - strain[row - 1]);
  CHECK(run.test.fracture_area() * run.test.stress_of_force() == Approx(1));
  CHECK(run.test.work() / run.test.fracture_area() == Approx(below * height_of(crystal(14, 10, 0.05))).epsilon(0.03));
  CHECK(run.test.friction() == run.body.energy().friction);
  CHECK(run.body.energy().balance_error() < 1e-2);
}

TEST_CASE("a loading is static only if half the speed changes its strength little, where that was checked",
          "[dem][laboratory]")
{
  dem::QuasiStatic how;
  how.imbalance = dem::Finding::of(0.005);
  how.kinetic   = dem::Finding::of(0.0005);
  CHECK(how.holds());
  dem::TestFigures test, slow;
  test.strength = dem::Finding::of(30e6);
  slow.strength = dem::Finding::of(29.7e6);
  how.speed     = dem::effect_of_speed(test, slow);
  CHECK(how.speed.value == Approx(0.01));
  CHECK(how.holds());
  slow.strength = dem::Finding::of(29.1e6);
  how.speed     = dem::effect_of_speed(test, slow);
  CHECK_FALSE(how.holds());
  slow.strength = dem::Finding::none("it did not break");
  how.speed     = dem::effect_of_speed(test, slow);
  CHECK_FALSE(how.speed.found);
  CHECK(how.speed.why_not == "at half the speed the strength is not determined: it did not break");
}

TEST_CASE("a test that cannot be is refused by the name of the entry", "[dem][laboratory]")
{
  const auto refused = [](const dem::LabParameters &p, const char *words) {
    CHECK_THROWS_WITH(Run(crystal(6, 4), discs(), strong(), p), Catch::Contains(words));
  };
  dem::LabParameters p = between_platens(0.1);
  p.press.axis         = 2;
  refused(p, "Axis");
  p = between_platens(0);
  refused(p, "Speed");
  p      = between_platens(0.1);
  p.test = Test::confined;
  refused(p, "Confining pressure");
  p.test = Test::tension;
  refused(p, "Glued layer");
  p.press.layer = 1;
  refused(p, "would meet");
  p      = between_platens(0.1);
  p.test = Test::bending;
  refused(p, "Span");
  p.press.span   = 1;
  p.press.roller = R;
  refused(p, "beyond its supports");
  p                 = between_platens(0.1);
  p.press.smoothing = 0.1;
  refused(p, "Smoothing depth");
}
