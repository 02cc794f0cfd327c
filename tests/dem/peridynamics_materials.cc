// Bodies of several materials, and what holds between these.
#include "dem/peridynamics/motion.h"
#include "peridynamics_bodies.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace peridynamic_tests;

namespace
{
  /** Right of the middle of a body the second material. */
  Mixture halves(const Grid &grid, const Material &left, const Material &right)
  {
    std::vector<std::int32_t> of(grid.places(), 0);
    for (const std::size_t i : grid.nodes())
      of[i] = grid.position(i).x() > 0 ? 1 : 0;
    return Mixture({left, right}, of);
  }

  Material material(const double modulus, const double critical_stretch)
  {
    Material m;
    m.young_modulus    = modulus;
    m.critical_stretch = critical_stretch;
    return m;
  }
} // namespace

TEST_CASE("bonds have the constants of their material, those between two of them of halves in series", "[dem]")
{
  const Case    c    = pulled_plate(20, Layout::cell_centred);
  const Grid    grid = c.grid();
  const Mixture both = halves(grid, material(E, 2e-3), material(4 * E, 1e-3));
  const Bonds   mixed(grid, c.horizon, both), plain = c.bonds();
  std::size_t   between = 0;
  plain.each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
    const std::int32_t stiff  = both.of[i] + both.of[j]; // ends in the second
    const double       factor = stiff == 0 ? 1 : stiff == 1 ? 1.6 : 4;
    CHECK(mixed.stiffness()[bond] == Approx(factor * plain.stiffness()[bond]).epsilon(1e-14));
    // E s is alike in both halves: 2e-3 E of the soft one is reached before 4e-3 E of the stiff one.
    CHECK(mixed.limit_of(bond) == Approx(stiff == 0 ? 2e-3 : stiff == 1 ? 2e-3 / 1.6 : 1e-3).epsilon(1e-14));
    between += stiff == 1 ? 1 : 0;
  });
  CHECK(between > 0);
}

TEST_CASE("a body of one material is the same to the last bit when both of its halves are named", "[dem]")
{
  const Case  c    = pulled_plate(20, Layout::cell_centred);
  const Grid  grid = c.grid();
  const Bonds halved(grid, c.horizon, halves(grid, c.material, c.material));
  CHECK(halved.stiffness() == c.bonds().stiffness());
  CHECK(halved.limits().empty());
}

TEST_CASE("a rod of two materials stretches as its halves in series, the nearer the shorter the horizon", "[dem]")
{
  const double exact = q * 0.5 / E + q * 0.5 / (3 * E);
  const auto   error = [&](const int cells) {
    const Case  c    = rod(cells, 3, BondModel::prototype, Layout::cell_centred, Volumes::partial);
    const Grid  grid = c.grid();
    const Bonds bonds(grid, c.horizon, halves(grid, material(E, 1), material(3 * E, 1)));
    const Field u    = displacement(c, bonds);
    const auto  last = grid.nodes().back();
    // Half a cell more at each end.
    const double ends = 0.5 / cells * (q / E + q / (3 * E));
    return std::abs(u.c[0][last] - u.c[0][grid.nodes().front()] + ends - exact) / exact;
  };
  const double coarse = error(50), fine = error(100), finer = error(200);
  CHECK(coarse < 0.02);
  CHECK(fine == Approx(coarse / 2).epsilon(0.05));
  CHECK(finer == Approx(fine / 2).epsilon(0.05));
}

TEST_CASE("a weak interface breaks first, and at its own critical stretch", "[dem]")
{
  const Case c                        = rod(100, 3, BondModel::prototype, Layout::cell_centred, Volumes::partial);
  const Grid grid                     = c.grid();
  Mixture    both                     = halves(grid, material(E, 5e-3), material(E, 5e-3));
  both.between(0, 1).critical_stretch = 2e-3;
  Bonds       bonds(grid, c.horizon, both);
  const Field u = displacement(c, bonds);
  Equilibrium equilibrium(bonds, Kinematics::linear, Solver::direct);
  CHECK(largest_stretch(bonds, equilibrium.forces(), u).of_limit == Approx(q / E / 2e-3).epsilon(1e-9));
  Field more = u;
  for (double &value : more.c[0])
    value *= 2.1; // the interface is beyond its limit, the rest is not
  break_stretched(bonds, equilibrium.forces(), more, 0);
  bonds.each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
    CHECK((bonds.stiffness()[bond] == 0) == (both.of[i] != both.of[j]));
  });
}

TEST_CASE("materials that are not bonded have no bond between them", "[dem]")
{
  const Case c                     = pulled_plate(20, Layout::cell_centred);
  const Grid grid                  = c.grid();
  Mixture    both                  = halves(grid, c.material, c.material);
  both.between(0, 1).young_modulus = 0;
  const Bonds apart(grid, c.horizon, both);
  Bonds       cut = c.bonds();
  CHECK(cut.cut({{0, -1, 0}, {0, 1, 0}, Eigen::Vector3d::Zero()}) > 0);
  CHECK(apart.stiffness() == cut.stiffness());
}

TEST_CASE("a wave from a soft into a stiff rod is sent back and on as their impedances say", "[dem]")
{
  // v reflected / v arriving = (Z1 - Z2) / (Z1 + Z2), v transmitted / v arriving = 2 Z1 / (Z1 + Z2), with Z = sqrt(E rho).
  const PushedRod pushed;
  Material        soft = material(E, 1), stiff = material(4 * E, 1);
  soft.density = stiff.density = density;
  const Grid   grid            = pushed.c.grid();
  Bonds        bonds(grid, pushed.c.horizon, halves(grid, soft, stiff));
  const Loads  loads = pushed.loads(bonds);
  const double speed = pushed.speed();
  Motion       motion(bonds, loads, Kinematics::linear, bonds.grid().field(), 0.5 * Motion::stable_step(bonds));
  double       arriving = 0, back = 0, on = 0;
  const auto   v = [&](const std::size_t i) { return motion.velocity().c[0][i]; };
  while (motion.time() < 0.75 / speed + PushedRod::duration)
    {
      motion.step(bonds, loads);
      if (motion.time() < 0.5 / speed) // at a quarter of the rod, before anything comes back there
        arriving = std::abs(v(200)) > std::abs(arriving) ? v(200) : arriving;
      else if (std::abs(v(200)) > std::abs(back))
        back = v(200);
      if (motion.time() < 0.75 / speed && std::abs(v(500)) > std::abs(on))
        on = v(500);
    }
  CHECK(back / arriving == Approx(-1.0 / 3.0).epsilon(0.03));
  CHECK(on / arriving == Approx(2.0 / 3.0).epsilon(0.03));
}
