// Walls, membranes and jackets that hold a specimen in a test of a laboratory: doc/theory/laboratory.md, 4.
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

#include <cmath>
#include <memory>

using Eigen::Vector3d;
using namespace laboratory;

TEST_CASE("servo walls and a membrane hold their pressure, and both find the same modulus", "[dem][laboratory][slow]")
{
  const double       pressure  = 2e6;
  dem::LabParameters requested = between_platens(0.01);
  requested.test               = Test::confined;
  requested.gain               = 0.5;
  requested.pressure           = pressure;
  requested.largest_speed      = 0.05;
  requested.stop_strain        = 3e-4;
  double E[2]                  = {0, 0};
  for (const auto how : {dem::LabParameters::Confinement::walls, dem::LabParameters::Confinement::membrane})
    {
      requested.confinement = how;
      INFO("confinement " << static_cast<int>(how));
      Run run(crystal(40, 20), discs(), strong(), requested);
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
  dem::SpecimenParameters p    = discs();
  p.physics.dimension          = 3;
  p.thickness                  = 0;
  dem::LabParameters requested = between_platens(0.1);
  requested.test               = Test::confined;
  requested.press.axis         = 2;
  requested.pressure           = 1e6;
  requested.largest_speed      = 0.05;
  for (const auto how : {dem::LabParameters::Confinement::walls, dem::LabParameters::Confinement::membrane})
    {
      requested.confinement = how;
      Run run(cluster::cubic_lattice(6, 6, 8, R), p, strong(), requested);
      run.to_end(400000);
      CHECK(run.test.notes().empty());
      CHECK(run.test.record().at(0, dem::TestRecord::stress) == Approx(1e6).epsilon(0.05));
      CHECK(run.body.energy().balance_error() < 1e-3);
    }
}

namespace
{
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
    dem::LabParameters requested = between_platens(0.02);
    requested.test               = Test::confined;
    requested.confinement        = dem::LabParameters::Confinement::cylinder;
    requested.press.axis         = 2;
    requested.press.smoothing    = 0.2 * R;
    requested.pressure           = pressure;
    requested.largest_speed      = 0.3;
    requested.gain               = 0.5;
    requested.rest               = 1e-3;
    requested.stop_strain        = 5e-4;
    return requested;
  }
} // namespace

TEST_CASE("a jacket of facets holds its pressure around a cylinder, which is as stiff in it as under a membrane",
          "[dem][laboratory][slow]")
{
  const double       pressure  = 2e6;
  const dem::Packing packing   = cylinder_of_spheres(9 * R, 28 * R);
  dem::LabParameters requested = in_a_jacket(pressure);
  double             E[2] = {0, 0}, nu[2] = {0, 0};
  for (const bool membrane : {false, true})
    {
      if (membrane)
        requested.confinement = dem::LabParameters::Confinement::membrane;
      INFO("membrane " << membrane);
      Run run(packing, spheres(), strong(), requested);
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
  dem::LabParameters requested = in_a_jacket(1e6);
  CHECK_THROWS_WITH(Run(cluster::cubic_lattice(6, 6, 8, R), spheres(), strong(), requested),
                    Catch::Contains("would touch the edges only"));
  requested.press.axis = 1;
  CHECK_THROWS_WITH(Run(crystal(6, 4), discs(), strong(), requested), Catch::Contains("no cylinder"));
}

TEST_CASE("tests of the laboratory have the same bits with any threads and after a restart", "[dem][laboratory][slow]")
{
  for (const char *const how : {"platens", "membrane", "jacket"})
    {
      const bool         membrane = how == std::string("membrane"), jacket = how == std::string("jacket");
      dem::LabParameters requested = between_platens(0.3);
      if (jacket)
        {
          requested               = in_a_jacket(5e5);
          requested.ramp_steps    = 300;
          requested.largest_speed = 1;
        }
      requested.speed           = jacket ? 1.5 : 0.3;
      requested.stop_strain     = 0.02;
      requested.press.smoothing = 0.2 * R;
      if (membrane)
        {
          requested.test        = Test::confined;
          requested.confinement = dem::LabParameters::Confinement::membrane;
          requested.pressure    = 5e5;
        }
      if (membrane || jacket)
        requested.rest = 1e-2;
      const auto made = [&] {
        return jacket ? std::make_unique<Run>(cylinder_of_spheres(5 * R, 12 * R), spheres(), weak(), requested) :
                        std::make_unique<Run>(crystal(10, 8, 0.05), discs(), weak(), requested);
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
