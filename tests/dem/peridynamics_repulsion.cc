// Nodes that no bond joins repel each other at short range.
#include "base/flat_state.h"
#include "dem/peridynamics/motion.h"
#include "peridynamics_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace peridynamic_tests;

namespace
{
  /** A plate in two halves, of which the right one flies into the left. */
  struct Clap
  {
    Case  c;
    Bonds bonds;
    Loads loads;
    Field velocity;

    explicit Clap(const double speed)
      : c(plate(40, Layout::cell_centred))
      , bonds((c.material.density = density, c.bonds()))
      , loads(c.loads(bonds))
      , velocity(bonds.grid().field())
    {
      bonds.cut({{0, -1, 0}, {0, 1, 0}, Eigen::Vector3d::Zero()});
      for (const std::size_t i : bonds.grid().nodes())
        velocity.c[0][i] = bonds.grid().position(i).x() > 0 ? -speed : 0.0;
    }

    Motion motion(const Field &at, const double repulsion)
    {
      Motion made(bonds, loads, Kinematics::nonlinear, at, 0.5 * Motion::stable_step(bonds, repulsion));
      if (repulsion > 0)
        made.repel(bonds, repulsion);
      return made;
    }
    /** Mean velocity of a half [m/s]. */
    double speed_of(const bool right, const Motion &m) const
    {
      double sum = 0, n = 0;
      for (const std::size_t i : bonds.grid().nodes())
        if ((bonds.grid().position(i).x() > 0) == right)
          {
            sum += m.velocity().c[0][i];
            n += 1;
          }
      return sum / n;
    }
    /** How far the faces are apart in the middle of the plate, over the spacing. */
    double gap(const Motion &m) const
    {
      const Grid &grid = bonds.grid();
      const auto  left = grid.place({19, 10, 0}), right = grid.place({20, 10, 0});
      return (grid.position(right).x() + m.displacement().c[0][right] - grid.position(left).x() -
              m.displacement().c[0][left]) /
             grid.spacing();
    }
  };
} // namespace

TEST_CASE("halves of a plate that clap together do not pass through each other, and energy and momentum are kept",
          "[dem]")
{
  Clap   clap(20);
  Motion motion  = clap.motion(clap.velocity, 15);
  double nearest = 2, worst = 0, largest = 0, pressed = 0;
  while (motion.time() < 5e-4)
    {
      motion.step(clap.bonds, clap.loads);
      const Energies e = motion.energies(clap.bonds);
      nearest          = std::min(nearest, clap.gap(motion));
      worst            = std::max(worst, std::abs(e.residual()));
      largest          = std::max(largest, e.largest());
      pressed          = std::max(pressed, e.repulsion);
    }
  CAPTURE(nearest, worst / largest, pressed / largest, motion.contacts());
  CHECK(nearest > 0.5);
  CHECK(nearest < 0.9); // they did touch
  CHECK(pressed > 1e-3 * largest);
  CHECK(worst < 1e-3 * largest);
  CHECK((motion.momentum(clap.bonds) - motion.impulse()).norm() < 1e-12 * motion.momentum(clap.bonds).norm());
  // Equal elastic bodies change velocities, but for the waves that stay behind in them.
  CHECK(motion.contacts() == 0);
  CHECK(clap.speed_of(false, motion) < -15);
  CHECK(std::abs(clap.speed_of(true, motion)) < 5);
}

TEST_CASE("without repulsion the halves of a plate pass through each other", "[dem]")
{
  Clap   clap(20);
  Motion motion  = clap.motion(clap.velocity, 0);
  double nearest = 2;
  while (motion.time() < 1e-3 && nearest > 0)
    {
      motion.step(clap.bonds, clap.loads);
      nearest = std::min(nearest, clap.gap(motion));
    }
  CHECK(nearest < 0.3);
  CHECK(clap.speed_of(false, motion) == 0);
}

TEST_CASE("bodies whose bonds are whole do not repel themselves", "[dem]")
{
  const auto run = [](const double repulsion) {
    Case c             = pulled_plate(30, Layout::cell_centred);
    c.material.density = density;
    Bonds        bonds = c.bonds();
    const Loads  loads = c.loads(bonds);
    const double step  = 0.2 * Motion::stable_step(bonds);
    Motion       motion(bonds, loads, Kinematics::nonlinear, bonds.grid().field(), step);
    if (repulsion > 0)
      motion.repel(bonds, repulsion);
    for (int n = 0; n < 50; ++n)
      motion.step(bonds, loads);
    return motion.displacement().c;
  };
  CHECK(run(0) == run(15));
}

TEST_CASE("a motion with repulsion is the same to the last bit for any number of threads, and from a saved state on",
          "[dem]")
{
  const int  threads = omp_get_max_threads();
  const auto whole   = [](const int with) {
    omp_set_num_threads(with);
    Clap   clap(200);
    Motion motion = clap.motion(clap.velocity, 15);
    for (int n = 0; n < 120; ++n)
      motion.step(clap.bonds, clap.loads);
    return std::pair{motion.displacement().c, motion.energies(clap.bonds).residual()};
  };
  const auto one = whole(1), three = whole(3);
  CHECK(one == three);

  Clap   clap(200);
  Motion motion = clap.motion(clap.velocity, 15), later = clap.motion(clap.velocity, 15);
  for (int n = 0; n < 60; ++n)
    motion.step(clap.bonds, clap.loads);
  CHECK(motion.contacts() > 0);
  base::Column          row;
  base::FlatStateWriter writer(row);
  motion.visit_state(writer);
  base::FlatStateReader reader(row);
  later.visit_state(reader);
  for (int n = 60; n < 120; ++n)
    later.step(clap.bonds, clap.loads);
  omp_set_num_threads(threads);
  CHECK(later.displacement().c == one.first);
}
