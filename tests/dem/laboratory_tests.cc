// Tests of a laboratory in the kernel against closed forms: doc/theory/laboratory.md.
#include "clusters.h"
#include "dem/core/uniform_random.h"
#include "dem/facets/surface.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/lattice.h"
#include "dem/packing/tiling.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <memory>

using Eigen::Vector3d;
using Test = dem::LabParameters::Test;

namespace
{
  constexpr double R = 1e-3, modulus = 10e9;

  dem::FlatJointParameters strong()
  {
    dem::FlatJointParameters p;
    p.effective_modulus    = modulus;
    p.stiffness_ratio      = 2.5;
    p.friction_coefficient = 0.2;
    p.tensile_strength = p.cohesion = 1e12;
    return p;
  }

  dem::FlatJointParameters weak()
  {
    dem::FlatJointParameters p = strong();
    p.tensile_strength         = 2e6;
    p.cohesion                 = 10e6;
    p.friction_angle           = 20;
    return p;
  }

  dem::SpecimenParameters discs()
  {
    dem::SpecimenParameters p = cluster::next_neighbours();
    p.physics.dimension       = 2;
    p.thickness               = 1;
    p.density                 = 2500;
    p.damping                 = 0.7;
    return p;
  }

  /** Rows along x. Radii a little unequal make a specimen of it that breaks like rock. */
  dem::Packing crystal(const int columns, const int rows, const double unequal = 0)
  {
    dem::Packing       packing = dem::make_lattice(dem::Lattice::hexagonal, R, {columns, rows, 1});
    dem::UniformRandom random(7);
    packing.periodic_cell.reset();
    for (double &r : packing.radius)
      r *= 1 - unequal * random();
    return packing;
  }

  dem::LabParameters between_platens(const double speed)
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

  /** A specimen in a test, led until it ends. */
  struct Run
  {
    Run(const dem::Packing            &packing,
        const dem::SpecimenParameters &p,
        const dem::LinkMaterials      &law,
        const dem::LabParameters      &asked)
      : body(packing, p, law)
      , test(body, asked)
    {
    }
    void advance(const std::int64_t steps)
    {
      if (test.finished())
        return;
      const auto lead = [this] {
        body.partners().clear_forces();
        test.lead();
      };
      lead();
      body.advance(steps, [&] {
        test.observe();
        lead();
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

  double crystal_modulus(const double kappa) { return 2 * std::sqrt(3) * (1 + 1 / kappa) / (3 + 1 / kappa) * modulus; }
} // namespace

TEST_CASE("hexagonal crystal between platens has the modulus and Poisson's ratio of the closed form (T8)",
          "[dem][laboratory][slow]")
{
  dem::LabParameters asked = between_platens(0.005);
  Run                run(crystal(61, 31), discs(), strong(), asked);
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
  dem::LabParameters asked = between_platens(0.02);
  asked.test               = Test::tension;
  asked.press.layer        = 0.5 * R;
  Run run(crystal(41, 31), discs(), strong(), asked);
  run.to_end(200000);
  const dem::TestFigures found = run.test.figures();
  CHECK(found.gauge_modulus.value == Approx(crystal_modulus(2.5)).epsilon(0.03));
  CHECK(found.poisson_slope.value == Approx(0.176471).margin(0.02));
  CHECK(run.body.energy().balance_error() < 1e-3);
}

TEST_CASE("beam of a crystal bends as three-point bending says, with shear", "[dem][laboratory][slow]")
{
  dem::LabParameters asked = between_platens(0.003);
  asked.test               = Test::bending;
  asked.press.along        = 0;
  asked.press.span         = 0.18;
  asked.press.roller       = 4e-3;
  asked.stop_strain        = 1e-4;
  Run run(crystal(100, 6), discs(), strong(), asked);
  run.to_end(400000);
  INFO("stress " << run.test.reading().stress << " strain " << run.test.reading().strain << " steps "
                 << run.body.steps() << " rows " << run.test.record().rows() << " gauge "
                 << run.test.reading().gauge_strain);
  const dem::TestFigures found = run.test.figures();
  REQUIRE(found.gauge_modulus.found);
  // A crystal of flat joints is stiffer in bending by what its joints resist of rotation; shear makes it softer by
  // 1 + 12 E I/(kappa G A L^2) = 1 + 2.4 (1 + nu) (d/L)^2.
  const double deep = (2 + 11 * std::sqrt(3)) * R, ratio = deep / asked.press.span;
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
  dem::LabParameters asked = between_platens(0.005);
  asked.test               = Test::splitting;
  asked.press.smoothing    = 0.4 * R;
  asked.stop_strain        = 2e-4;
  Run run(disk, discs(), strong(), asked);
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
  dem::LabParameters asked = between_platens(0.02);
  asked.press.smoothing    = 0.4 * R;
  dem::Packing rough       = crystal(12, 6, 0.1);
  Run          run(rough, discs(), weak(), asked);
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
  dem::LabParameters asked  = between_platens(0.02);
  dem::Packing       rough  = crystal(12, 6, 0.1);
  const int          axis   = asked.press.axis;
  double             lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t i = 0; i < rough.size(); ++i)
    {
      lowest  = std::min(lowest, rough.centre[i][axis] - rough.radius[i]);
      highest = std::max(highest, rough.centre[i][axis] + rough.radius[i]);
    }
  asked.press.stand = {lowest + 0.3 * R, highest - 0.2 * R};
  dem::Specimen    body(rough, discs(), weak());
  const dem::Press press(body, asked.press);
  CHECK(press.planes().low == lowest + 0.3 * R);
  CHECK(press.planes().high == highest - 0.2 * R);
  CHECK(press.height() == Approx(highest - lowest - 0.5 * R).epsilon(1e-12));
  Run run(rough, discs(), weak(), asked);
  run.body.partners().find_surface_forces();
  CHECK(run.body.surfaces().at(0).total_force.norm() == 0);
  CHECK(run.body.surfaces().at(1).total_force.norm() == 0);
  run.advance(500);
  CHECK(run.body.counts().wall_contacts > 12);
}

TEST_CASE("a specimen that still grows wider is not at rest, whatever its forces", "[dem][laboratory]")
{
  dem::LabParameters asked = between_platens(0.02);
  asked.seating_stress     = 1e3;
  asked.rest               = 1; // any force will do
  Run          run(crystal(12, 8), discs(), strong(), asked);
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
  dem::LabParameters asked = between_platens(0.02);
  asked.section            = 0.03;
  CHECK(Run(crystal(12, 6), discs(), strong(), asked).test.stress_of_force() == Approx(1 / 0.03).epsilon(1e-12));
  asked.section.reset();
  const Run    plain(crystal(12, 6), discs(), strong(), asked);
  const double wide = dem::BodyExtent(plain.body.particles()).length(0);
  CHECK(plain.test.stress_of_force() == Approx(1 / wide).epsilon(1e-12));
  asked.test = Test::splitting; // what is loaded here has flats: it is not as high as wide
  CHECK(Run(crystal(12, 6), discs(), strong(), asked).test.stress_of_force() ==
        Approx(2 / (M_PI * wide)).epsilon(1e-12));
}

TEST_CASE("specimen loaded to a tenth of its strength and unloaded is what it was (genesis 7)",
          "[dem][laboratory][slow]")
{
  const auto         packing = crystal(12, 8, 0.05);
  dem::LabParameters asked   = between_platens(0.05);
  asked.stop_strain          = 0.02;
  asked.press.smoothing      = 0.2 * R;
  Run whole(packing, discs(), weak(), asked);
  whole.to_end(400000);
  REQUIRE(whole.test.figures().strength.found);
  const double strength = whole.test.figures().strength.value;

  dem::Specimen        body(packing, discs(), weak());
  dem::PressParameters machine = asked.press;
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

TEST_CASE("servo walls and a membrane hold their pressure, and both find the same modulus", "[dem][laboratory][slow]")
{
  const double       pressure = 2e6;
  dem::LabParameters asked    = between_platens(0.01);
  asked.test                  = Test::confined;
  asked.gain                  = 0.5;
  asked.pressure              = pressure;
  asked.largest_speed         = 0.05;
  asked.stop_strain           = 3e-4;
  double E[2]                 = {0, 0};
  for (const auto how : {dem::LabParameters::Confinement::walls, dem::LabParameters::Confinement::membrane})
    {
      asked.confinement = how;
      INFO("confinement " << static_cast<int>(how));
      Run run(crystal(40, 20), discs(), strong(), asked);
      run.to_end(600000);
      CHECK(run.test.notes().empty());
      const dem::TestRecord &record = run.test.record();
      double                 worst  = 0;
      for (std::size_t row = record.rows() / 4; row < record.rows(); ++row)
        worst = std::max(worst, std::abs(record.at(row, dem::TestRecord::confinement) / pressure - 1));
      CHECK(worst < 0.02);
      CHECK(record.at(0, dem::TestRecord::stress) == Approx(pressure).epsilon(0.03));
      CHECK(run.body.energy().balance_error() < 1e-3);
      E[how == dem::LabParameters::Confinement::walls ? 0 : 1] = run.test.figures().gauge_modulus.value;
    }
  CHECK(E[0] == Approx(crystal_modulus(2.5)).epsilon(0.04));
  CHECK(E[1] == Approx(E[0]).epsilon(0.04));
}

TEST_CASE("triaxial walls hold a cube of spheres at a pressure from all sides", "[dem][laboratory][slow]")
{
  dem::SpecimenParameters p = discs();
  p.physics.dimension       = 3;
  p.thickness               = 0;
  dem::LabParameters asked  = between_platens(0.1);
  asked.test                = Test::confined;
  asked.press.axis          = 2;
  asked.pressure            = 1e6;
  asked.largest_speed       = 0.05;
  for (const auto how : {dem::LabParameters::Confinement::walls, dem::LabParameters::Confinement::membrane})
    {
      asked.confinement = how;
      Run run(cluster::cubic_lattice(6, 6, 8, R), p, strong(), asked);
      run.to_end(400000);
      CHECK(run.test.notes().empty());
      CHECK(run.test.record().at(0, dem::TestRecord::stress) == Approx(1e6).epsilon(0.05));
      CHECK(run.body.energy().balance_error() < 1e-3);
    }
}

namespace
{
  /** A close packing of spheres cut to an upright cylinder, its radii a little unequal. */
  dem::Packing cylinder_of_spheres(const double radius, const double height)
  {
    const int          across = static_cast<int>(std::ceil(radius / (std::sqrt(2) * R))) + 1;
    const int          along  = static_cast<int>(std::ceil(height / (2 * std::sqrt(2) * R))) + 1;
    const auto         whole  = dem::make_lattice(dem::Lattice::face_centred_cubic, R, {across, across, along});
    const Vector3d     middle = 0.5 * *whole.periodic_cell;
    dem::Packing       packing;
    dem::UniformRandom random(11);
    for (const Vector3d &x : whole.centre)
      if ((x - middle).head<2>().norm() <= radius - R && std::abs(x.z() - middle.z()) <= 0.5 * height - R)
        {
          packing.centre.push_back(x);
          packing.radius.push_back(R * (1 - 0.02 * random()));
        }
    return packing;
  }

  dem::SpecimenParameters spheres()
  {
    dem::SpecimenParameters p = discs();
    p.physics.dimension       = 3;
    p.thickness               = 0;
    p.interaction_ratio       = 1.1;
    return p;
  }

  dem::LabParameters in_a_jacket(const double pressure)
  {
    dem::LabParameters asked = between_platens(0.02);
    asked.test               = Test::confined;
    asked.confinement        = dem::LabParameters::Confinement::cylinder;
    asked.press.axis         = 2;
    asked.press.smoothing    = 0.2 * R;
    asked.pressure           = pressure;
    asked.largest_speed      = 0.3;
    asked.gain               = 0.5;
    asked.rest               = 1e-3;
    asked.stop_strain        = 5e-4;
    return asked;
  }
} // namespace

TEST_CASE("a jacket of facets holds its pressure around a cylinder, which is as stiff in it as under a membrane",
          "[dem][laboratory][slow]")
{
  const double       pressure = 2e6;
  const dem::Packing packing  = cylinder_of_spheres(9 * R, 28 * R);
  dem::LabParameters asked    = in_a_jacket(pressure);
  double             E[2] = {0, 0}, nu[2] = {0, 0};
  for (const bool membrane : {false, true})
    {
      if (membrane)
        asked.confinement = dem::LabParameters::Confinement::membrane;
      INFO("membrane " << membrane);
      Run run(packing, spheres(), strong(), asked);
      run.to_end(600000);
      CHECK(run.test.notes().empty());
      const dem::TestRecord &record = run.test.record();
      double                 worst  = 0;
      for (std::size_t row = 0; row < record.rows(); ++row)
        worst = std::max(worst, std::abs(record.at(row, dem::TestRecord::confinement) / pressure - 1));
      CHECK(worst < 0.01);
      CHECK(run.body.energy().balance_error() < 1e-3);
      E[membrane]  = run.test.figures().gauge_modulus.value;
      nu[membrane] = run.test.figures().poisson_slope.value;
      if (membrane)
        continue;
      // What the jacket says is what the specimen bears, by the forces inside: across planes through its axis, in the mean of their
      // directions (a rigid jacket presses harder where the crystal is).
      const Vector3d middle =
        0.5 * (run.body.surfaces().at(2).place[0] + run.body.surfaces().at(2 + dem::CylinderWall::sides / 2).place[0]);
      const double radius = (run.body.surfaces().at(2).place[0] - middle).norm();
      const auto   ends   = [&](const std::size_t n) { return run.body.surfaces().at(n).place[0].z(); };
      const int    planes = 36;
      const auto   links  = run.body.links();
      double       across = 0;
      for (int k = 0; k < planes; ++k)
        {
          const Vector3d normal(std::cos(k * M_PI / planes), std::sin(k * M_PI / planes), 0);
          for (const dem::LinkLoad &load : links.load)
            {
              const double first = normal.dot(load.first - middle), second = normal.dot(load.second() - middle);
              if (first * second < 0)
                across += normal.dot(load.force) * (first < 0 ? -1 : 1) / planes;
            }
        }
      CHECK(across / (2 * radius * (ends(1) - ends(0))) == Approx(pressure).epsilon(0.01));
    }
  CHECK(E[0] == Approx(E[1]).epsilon(0.03));
  CHECK(nu[0] == Approx(nu[1]).margin(0.03));
}

TEST_CASE("a jacket goes around cylinders only, and in space only", "[dem][laboratory]")
{
  dem::LabParameters asked = in_a_jacket(1e6);
  CHECK_THROWS_WITH(Run(cluster::cubic_lattice(6, 6, 8, R), spheres(), strong(), asked),
                    Catch::Contains("would touch the edges only"));
  asked.press.axis = 1;
  CHECK_THROWS_WITH(Run(crystal(6, 4), discs(), strong(), asked), Catch::Contains("no cylinder"));
}

TEST_CASE("a weak specimen breaks, and its test ends past the peak with figures", "[dem][laboratory][slow]")
{
  dem::LabParameters asked = between_platens(0.1);
  asked.stop_strain        = 0.02;
  asked.seating_stress     = 1e5;
  Run run(crystal(14, 10, 0.05), discs(), weak(), asked);
  run.to_end(400000);
  const dem::TestFigures found = run.test.figures();
  REQUIRE(found.strength.found);
  CHECK(run.test.seated_strain() > 0);
  CHECK(run.body.logged_breaks() > 10);
  CHECK(found.smooth_strength.value <= found.strength.value);
  CHECK(found.smooth_strength.value > 0.9 * found.strength.value);
  CHECK(run.test.reading().stress < 0.7 * found.strength.value);
  CHECK(found.modulus.found);
  CHECK(run.body.energy().balance_error() < 1e-2);
}

TEST_CASE("tests of the laboratory have the same bits with any threads and after a restart", "[dem][laboratory][slow]")
{
  for (const char *const how : {"platens", "membrane", "jacket"})
    {
      const bool         membrane = how == std::string("membrane"), jacket = how == std::string("jacket");
      dem::LabParameters asked = between_platens(0.3);
      if (jacket)
        {
          asked               = in_a_jacket(5e5);
          asked.ramp_steps    = 300;
          asked.largest_speed = 1;
        }
      asked.speed           = jacket ? 1.5 : 0.3;
      asked.stop_strain     = 0.02;
      asked.press.smoothing = 0.2 * R;
      if (membrane)
        {
          asked.test        = Test::confined;
          asked.confinement = dem::LabParameters::Confinement::membrane;
          asked.pressure    = 5e5;
        }
      if (membrane || jacket)
        asked.rest = 1e-2;
      const auto made = [&] {
        return jacket ? std::make_unique<Run>(cylinder_of_spheres(5 * R, 12 * R), spheres(), weak(), asked) :
                        std::make_unique<Run>(crystal(10, 8, 0.05), discs(), weak(), asked);
      };
      const auto state_of = [](Run &run) {
        MemoryState         memory;
        MemoryState::Writer writer(memory);
        run.body.visit_state(writer);
        run.test.visit_state(writer);
        return memory;
      };
      const std::int64_t steps = 5500;
      omp_set_num_threads(1);
      auto one = made();
      one->advance(2500);
      MemoryState half = state_of(*one);
      one->advance(steps - 2500);
      const MemoryState end = state_of(*one);
      INFO(how << ", strain " << one->test.reading().strain);
      CHECK(one->body.logged_breaks() > 0);
      omp_set_num_threads(3);
      auto several = made();
      several->advance(steps);
      CHECK(state_of(*several) == end);
      omp_set_num_threads(1);
      auto                resumed = made();
      MemoryState::Reader reader(half);
      resumed->body.visit_state(reader);
      resumed->test.visit_state(reader);
      resumed->advance(steps - 2500);
      CHECK(state_of(*resumed) == end);
    }
}

TEST_CASE("a loading is static only if half the speed changes its strength little, where that was looked at",
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
