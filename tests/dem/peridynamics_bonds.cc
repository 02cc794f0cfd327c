#include "peridynamics_bodies.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace peridynamic_tests;

namespace
{
  const double degree = std::acos(-1.0) / 180;

  Case block(const Layout layout)
  {
    Case c            = plate(10, layout);
    c.body.space      = Space::space;
    c.body.size       = {1.0, 0.6, 0.4};
    c.body.holes      = {{"hole", {0.1, 0.05, 0}, 0.16}};
    c.horizon.volumes = Volumes::partial;
    return c;
  }

  Case some_plate() { return plate_with_hole(Layout::cell_centred); }

  /** A displacement that is smooth and has no symmetry. */
  Field bent(const Grid &grid, const double size)
  {
    Field u = grid.field();
    for (const std::size_t i : grid.nodes())
      {
        const Eigen::Vector3d x = grid.position(i);
        u.add(i, size * Eigen::Vector3d(std::sin(3 * x.x() + x.y()) + x.z(), std::cos(2 * x.y()) * x.x(),
                                        x.x() * x.y() + 0.3 * x.z()));
      }
    return u;
  }

  /** Forces bond by bond, as the formulas say. */
  Field forces_one_by_one(const Bonds &bonds, const Kinematics kinematics, const Field &u)
  {
    Field f = bonds.grid().field();
    bonds.each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      const Eigen::Vector3d xi = bonds.grid().position(j) - bonds.grid().position(i), eta = u.at(j) - u.at(i),
                            y = xi + eta;
      const double          l = xi.norm(), k = bonds.stiffness()[bond];
      const Eigen::Vector3d pull = kinematics == Kinematics::linear ?
                                     Eigen::Vector3d(k * xi.dot(eta) / (l * l * l) * xi) :
                                     Eigen::Vector3d(k * (y.norm() - l) / l * y.normalized());
      f.add(i, pull);
      f.add(j, -pull);
    });
    return f;
  }

  double largest(const Field &f)
  {
    double m = 0;
    for (const auto &column : f.c)
      for (const double v : column)
        m = std::max(m, std::abs(v));
    return m;
  }

  Field difference(Field a, const Field &b)
  {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < a.c[c].size(); ++i)
        a.c[c][i] -= b.c[c][i];
    return a;
  }
} // namespace

TEST_CASE("forces of eight bonds at a time are those of the formulas, in every dimension, layout and kinematics",
          "[dem]")
{
  Case line                       = rod(40, 3.0, BondModel::general, Layout::boundary_nodes, Volumes::partial);
  Case wide                       = plate(20, Layout::boundary_nodes);
  wide.horizon.surface_correction = true;
  for (const Case &c : {line, wide, some_plate(), block(Layout::cell_centred), block(Layout::boundary_nodes)})
    for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear})
      {
        const Bonds bonds = c.bonds();
        const Field u     = bent(bonds.grid(), 1e-2);
        BondForces  forces(bonds, kinematics);
        Field       f = bonds.grid().field();
        forces.add_up(bonds, u, f);
        CHECK(largest(f) > 0);
        CHECK(largest(difference(forces_one_by_one(bonds, kinematics, u), f)) < 1e-11 * largest(f));
      }
}

TEST_CASE("forces are minus the gradient of the bonds' energy", "[dem]")
{
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear})
    {
      const Bonds bonds = block(Layout::cell_centred).bonds();
      BondForces  forces(bonds, kinematics);
      Field       u = bent(bonds.grid(), 1e-2), v = bent(bonds.grid(), -0.37), f = bonds.grid().field();
      v.c[0].swap(v.c[1]);
      forces.add_up(bonds, u, f);
      double       power = 0;
      const double h     = 1e-6;
      Field        ahead = u, behind = u;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < u.c[c].size(); ++i)
          {
            power -= f.c[c][i] * v.c[c][i];
            ahead.c[c][i] += h * v.c[c][i];
            behind.c[c][i] -= h * v.c[c][i];
          }
      CHECK((forces.energy(bonds, ahead) - forces.energy(bonds, behind)) / (2 * h) == Approx(power).epsilon(1e-7));
    }
}

TEST_CASE("a rotation by 30 degrees leaves every bond without force where kinematics is nonlinear", "[dem]")
{
  for (const Case &c : {some_plate(), block(Layout::boundary_nodes)})
    {
      const Bonds bonds = c.bonds();
      const auto  turn  = Eigen::AngleAxisd(30 * degree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      Field       u = bonds.grid().field(), f = bonds.grid().field(), stretched = bonds.grid().field();
      Field       g = bonds.grid().field();
      for (const std::size_t i : bonds.grid().nodes())
        {
          u.add(i, turn * bonds.grid().position(i) - bonds.grid().position(i));
          stretched.add(i, 0.5 * bonds.grid().position(i));
        }
      BondForces forces(bonds, Kinematics::nonlinear);
      forces.add_up(bonds, u, f);
      forces.add_up(bonds, stretched, g);
      CHECK(largest(g) > 0);
      CHECK(largest(f) < 1e-10 * largest(g));
      double s = 0;
      bonds.each([&](std::size_t, const std::size_t o, const std::size_t i, const std::size_t j) {
        s = std::max(s, std::abs(forces.stretch(bonds, o, i, j, u)));
      });
      CHECK(s < 1e-13);
    }
}

TEST_CASE("a straight crack between two rows of nodes leaves damages of 11/28, 6/28 and 1/28 beside it", "[dem]")
{
  Bonds bonds = plate(60, Layout::cell_centred).bonds();
  CHECK(bonds.cut({{-1, 0, 0}, {1, 0, 0}, Eigen::Vector3d::Zero()}) > 0);
  const std::vector<double> damage = bonds.damage();
  const auto                near   = [&](const int row) {
    return damage[static_cast<std::size_t>(bonds.grid().number(bonds.grid().place({30, 15 + row, 0})))];
  };
  for (const int side : {0, 1})
    {
      CHECK(near(side == 0 ? 0 : -1) == Approx(11.0 / 28).epsilon(1e-14));
      CHECK(near(side == 0 ? 1 : -2) == Approx(6.0 / 28).epsilon(1e-14));
      CHECK(near(side == 0 ? 2 : -3) == Approx(1.0 / 28).epsilon(1e-14));
      CHECK(near(side == 0 ? 3 : -4) == 0);
    }
}

TEST_CASE("a bond that is stretched to its limit pulls neither end from then on, and its energy is accounted for",
          "[dem]")
{
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear})
    {
      Case c                      = plate(40, Layout::cell_centred);
      c.material.critical_stretch = 5e-3;
      Bonds             bonds = c.bonds(), whole = bonds;
      const Field       u = bent(bonds.grid(), 5e-3);
      Field             f = bonds.grid().field(), g = bonds.grid().field();
      BondForces        forces(bonds, kinematics);
      const double      before  = forces.energy(bonds, u);
      const BondAccount account = forces.add_up_and_break(bonds, u, nullptr, f);
      std::int64_t      beyond  = 0;
      whole.each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
        const bool over = forces.stretch(whole, o, i, j, u) >= 5e-3;
        CHECK((bonds.stiffness()[bond] == 0) == over);
        beyond += over ? 1 : 0;
      });
      CHECK(beyond > 0);
      CHECK(account.broken == beyond);
      CHECK(account.released == Approx(before - forces.energy(bonds, u)).epsilon(1e-11));
      CHECK(largest(difference(forces_one_by_one(bonds, kinematics, u), f)) < 1e-11 * largest(f));
      CHECK(forces.add_up_and_break(bonds, u, nullptr, g).broken == 0);
    }
}

TEST_CASE("forces and broken bonds are the same to the last bit for any number of threads", "[dem]")
{
  for (Case c : {plate(200, Layout::cell_centred), block(Layout::boundary_nodes)})
    {
      c.material.critical_stretch       = 5e-3;
      const int                 threads = omp_get_max_threads();
      std::vector<Field>        f;
      std::vector<base::Column> k;
      std::vector<double>       released;
      for (const int n : {1, 2, 3})
        {
          omp_set_num_threads(n);
          Bonds      bonds = c.bonds();
          BondForces forces(bonds, Kinematics::nonlinear);
          f.push_back(bonds.grid().field());
          released.push_back(forces.add_up_and_break(bonds, bent(bonds.grid(), 5e-3), nullptr, f.back()).released);
          k.push_back(bonds.stiffness());
        }
      omp_set_num_threads(threads);
      CHECK(released[0] > 0);
      for (const int n : {1, 2})
        {
          CHECK(f[0].c == f[static_cast<std::size_t>(n)].c);
          CHECK(k[0] == k[static_cast<std::size_t>(n)]);
          CHECK(released[0] == released[static_cast<std::size_t>(n)]);
        }
    }
}

TEST_CASE("a crack cuts the bonds that cross it and no other, in the plane and in space", "[dem]")
{
  const Precrack segment{{0, 0, 0}, {1, 0, 0}, Eigen::Vector3d::Zero()};
  CHECK(segment.crosses({0.5, -1, 0}, {0.5, 1, 0}, 2));
  CHECK_FALSE(segment.crosses({1.5, -1, 0}, {1.5, 1, 0}, 2));
  CHECK_FALSE(segment.crosses({0.5, 0.1, 0}, {0.5, 1, 0}, 2));
  const Precrack sheet{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  CHECK(sheet.crosses({0.5, -1, 0.5}, {0.5, 1, 0.5}, 3));
  CHECK_FALSE(sheet.crosses({0.5, -1, 1.5}, {0.5, 1, 1.5}, 3));
  CHECK_FALSE(sheet.crosses({-0.1, -1, 0.5}, {-0.1, 1, 0.5}, 3));
  CHECK_FALSE(sheet.crosses({0.5, 1, 0.5}, {0.5, 2, 0.5}, 3));
}

TEST_CASE("degenerate bodies are refused by name", "[dem]")
{
  using Catch::Contains;
  Case c         = plate(10, Layout::cell_centred);
  c.body.spacing = 0.3;
  CHECK_THROWS_WITH(c.grid(), Contains("Grid/Spacing") && Contains("divide"));
  c            = plate(10, Layout::cell_centred);
  c.body.holes = {{"all", Eigen::Vector3d::Zero(), 2.0}};
  CHECK_THROWS_WITH(c.grid(), Contains("Holes"));
  c           = plate(10, Layout::cell_centred);
  Bonds bonds = c.bonds();
  bonds.each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
    if (i == bonds.grid().nodes()[0] || j == bonds.grid().nodes()[0])
      bonds.break_bond(bond);
  });
  CHECK_THROWS_WITH(bonds.refuse_isolated_nodes(), Contains("node 1") && Contains("isolated"));
  CHECK_THROWS_WITH(boundary_points(c.grid(), "front"), Contains("front") && Contains("left, right, bottom, top"));
}

TEST_CASE("a side of a body has the points of its word where it is called by its axis", "[dem]")
{
  const Case c = plate(10, Layout::cell_centred);
  for (const auto &[word, by_axis] : std::vector<std::pair<const char *, const char *>>{
         {"left", "x min"}, {"right", "x max"}, {"bottom", "y min"}, {"top", "y max"}})
    {
      const std::vector<BoundaryPoint> one   = boundary_points(c.grid(), word),
                                       other = boundary_points(c.grid(), by_axis);
      REQUIRE_FALSE(one.empty());
      REQUIRE(other.size() == one.size());
      for (std::size_t p = 0; p < one.size(); ++p)
        CHECK(one[p].place == other[p].place);
    }
  CHECK_THROWS_WITH(boundary_points(c.grid(), "z min"), Catch::Contains("z min: is neither a side"));
}
