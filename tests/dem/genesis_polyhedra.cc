// Convex bodies that pebbles stand for: volume, centre and inertia in closed form, what is refused, how they are filled and tumble.
#include "base/errors.h"
#include "dem/genesis/convex_body.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/packed_clumps.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using Catch::Contains;
using dem::Polyhedron;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  const double golden = 0.5 * (1 + std::sqrt(5.0));

  std::vector<Vector3d> cuboid(const Vector3d &edges)
  {
    std::vector<Vector3d> all;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5})
          all.push_back(edges.cwiseProduct(Vector3d(x, y, z)));
    return all;
  }

  /** Of edge sqrt(8). */
  std::vector<Vector3d> tetrahedron() { return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; }

  /** Of edge sqrt(2). */
  std::vector<Vector3d> octahedron() { return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}; }

  /** Twelve triangles' worth of pentagons: of edge 2/golden. */
  std::vector<Vector3d> dodecahedron()
  {
    std::vector<Vector3d> all = cuboid({2, 2, 2});
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0})
        {
          all.emplace_back(0, s / golden, t * golden);
          all.emplace_back(s / golden, t * golden, 0);
          all.emplace_back(t * golden, 0, s / golden);
        }
    return all;
  }

  /** The same somewhere else, its corners in another order. */
  std::vector<Vector3d> moved(std::vector<Vector3d> corners, const Matrix3d &turn, const Vector3d &by)
  {
    for (Vector3d &c : corners)
      c = turn * c + by;
    std::rotate(corners.begin(), corners.begin() + 2, corners.end());
    return corners;
  }

  Matrix3d turn_by(const Vector3d &rotation)
  {
    return Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }

  dem::SpecimenParameters in_space(const double density, const int dimension = 3)
  {
    dem::SpecimenParameters p;
    p.physics.dimension = dimension;
    p.density           = density;
    p.interaction_ratio = 1;
    p.thickness         = dimension == 2 ? 0.5 : 0;
    return p;
  }

  dem::LinearContactParameters stiff_grains()
  {
    dem::LinearContactParameters p;
    p.effective_modulus = 1e8;
    return p;
  }

  /** Filled, of a density, free of everything. */
  dem::Specimen free_body(const dem::Packing &packing, const dem::SpecimenParameters &p)
  {
    const dem::LinkMaterials law(stiff_grains());
    dem::Specimen            made(packing, p, law);
    dem::add_packed_clumps(made, packing, law);
    return made;
  }

  void set_motion(dem::Specimen &body, const dem::Packing &packing, const Vector3d &velocity, const Vector3d &spin)
  {
    for (std::size_t i = 0; i < packing.size(); ++i)
      body.set_velocity(i, velocity + spin.cross(packing.centre[i] - packing.bodies[0].centre), spin);
  }
} // namespace

TEST_CASE("volume, centre and inertia of polyhedra are those of closed forms, however they are turned", "[dem][clumps]")
{
  struct Known
  {
    std::vector<Vector3d> corners;
    double                volume;
    Vector3d              inertia; ///< over the mass
  };
  const double   s     = 2 / golden; // edge of the dodecahedron
  const Vector3d edges = {3, 1, 0.5};
  const Known    all[] = {
       {cuboid(edges), 1.5, Vector3d(1 + 0.25, 9 + 0.25, 9 + 1) / 12},
       {tetrahedron(), std::pow(8, 1.5) / (6 * std::sqrt(2)), Vector3d::Constant(8.0 / 20)},
       {octahedron(), std::sqrt(2) / 3 * std::pow(2, 1.5), Vector3d::Constant(2.0 / 10)},
       {dodecahedron(), (15 + 7 * std::sqrt(5)) / 4 * s * s * s, Vector3d::Constant((39 * golden + 28) / 150 * s * s)}};
  for (const Known &known : all)
    for (const Vector3d &rotation : {Vector3d(1e-30, 0, 0), Vector3d(0.4, -1.1, 0.7), Vector3d(2, 0.3, 0.1)})
      for (const double size : {1.0, 1e-3})
        {
          const Matrix3d turn = turn_by(rotation);
          const Vector3d by(5 * size, -3 * size, 2 * size);
          auto           corners = known.corners;
          for (Vector3d &c : corners)
            c *= size;
          const dem::PackedBody found  = dem::body_of(Polyhedron(moved(corners, turn, by)));
          const Matrix3d        wanted = size * size * turn * known.inertia.asDiagonal() * turn.transpose();
          CHECK(found.volume == Approx(known.volume * std::pow(size, 3)).epsilon(1e-12));
          CHECK((found.centre - by).norm() < 1e-12 * size);
          CHECK((found.inertia - wanted).norm() < 1e-11 * wanted.norm());
        }
}

TEST_CASE("a polyhedron cut in two has the moments of its two parts", "[dem][clumps]")
{
  // An irregular body: a box of which a plane through four places of its edges cuts a part.
  const std::vector<Vector3d> low  = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                              high = {{0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}},
                              cut  = {{0, 0, 1.2}, {2, 0, 2.5}, {2, 1, 2.1}, {0, 1, 0.8}};
  const auto together              = [](std::vector<Vector3d> a, const std::vector<Vector3d> &b) {
    a.insert(a.end(), b.begin(), b.end());
    return Polyhedron(a);
  };
  const Polyhedron whole = together(low, high), one = together(low, cut), other = together(cut, high);
  CHECK(one.volume() + other.volume() == Approx(whole.volume()).epsilon(1e-12));
  const auto first = [](const Polyhedron &p) -> Vector3d { return p.volume() * p.centroid(); };
  CHECK((first(one) + first(other) - first(whole)).norm() < 1e-12);
  const auto second = [](const Polyhedron &p) -> Matrix3d {
    return p.volume() * (p.second_moments() + p.centroid() * p.centroid().transpose());
  };
  CHECK((second(one) + second(other) - second(whole)).norm() < 1e-12 * second(whole).norm());
  CHECK(one.depth({1, 0.5, 0.1}) == Approx(0.1));
  CHECK(one.depth({1, 0.5, -0.1}) == Approx(-0.1));
}

TEST_CASE("corners that bound no convex body are refused by number", "[dem][clumps]")
{
  const auto with = [](const Vector3d &more) {
    auto corners = cuboid({1, 1, 1});
    corners.push_back(more);
    return corners;
  };
  CHECK_THROWS_WITH(Polyhedron(with({0.1, 0, 0.2})), Contains("not convex: corner 9 lies inside"));
  CHECK_THROWS_WITH(Polyhedron(with({0.5, 0.1, 0.2})), Contains("corner 9 does not stand out"));
  CHECK_THROWS_WITH(Polyhedron(with({0.5, 0.5, 0.2})), Contains("corner 9 does not stand out"));
  CHECK_THROWS_WITH(Polyhedron(with({0.5, 0.5, 0.5})), Contains("corner 8 and corner 9 are the same place"));
  CHECK_THROWS_WITH(Polyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), Contains("at least 4 corners"));
  CHECK_THROWS_WITH(Polyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 2, 0}}), Contains("in one plane"));
  CHECK_THROWS_WITH(Polyhedron(cuboid({1, 1, 5e-6})), Contains("the body is flat"));
  CHECK_NOTHROW(Polyhedron(cuboid({1, 1, 1e-3})));
}

TEST_CASE("outlines that bound no convex polygon are refused by number, and run either way round", "[dem][clumps]")
{
  using Corners        = std::vector<Eigen::Vector2d>;
  const Corners square = {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, other_way(square.rbegin(), square.rend());
  CHECK(dem::convex_polygon(square).area() == 2);
  CHECK(dem::convex_polygon(other_way).area() == 2);
  CHECK(dem::convex_polygon(other_way).depth({0.3, 0.5}) == Approx(0.3));
  CHECK(dem::convex_polygon(square).depth({-0.3, 0.5}) == Approx(-0.3));
  CHECK_THROWS_WITH(dem::convex_polygon({{0, 0}, {2, 0}, {0.5, 0.4}, {0, 1}}), Contains("not convex at corner 3"));
  CHECK_THROWS_WITH(dem::convex_polygon({{0, 0}, {1, 0}, {2, 0}, {0, 1}}), Contains("not convex at corner 2"));
  CHECK_THROWS_WITH(dem::convex_polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), Contains("not convex at corner"));
  CHECK_THROWS_WITH(dem::convex_polygon({{0, 0}, {1, 0}}), Contains("at least 3 corners"));
  Corners star;
  for (int k = 0; k < 5; ++k)
    star.emplace_back(std::cos(0.8 * M_PI * k), std::sin(0.8 * M_PI * k));
  CHECK_THROWS_WITH(dem::convex_polygon(star), Contains("crosses itself"));
}

TEST_CASE("pebbles fill a body wholly inside it, as many as the lattice lets, and it keeps its own mass",
          "[dem][clumps]")
{
  const double r = 1e-3;
  for (const int n : {2, 3, 5})
    {
      const dem::ConvexBody cube(cuboid(Vector3d::Constant(2 * n * r)), 3);
      CHECK(dem::filled_with_pebbles(cube, r, dem::Filling::cubic).size() == static_cast<std::size_t>(n * n * n));
    }
  const dem::ConvexBody body(moved(dodecahedron(), turn_by({0.2, 0.5, -0.4}), {3, 1, 2}), 3);
  for (const auto filling : {dem::Filling::close, dem::Filling::cubic})
    {
      const dem::Packing packing = dem::filled_with_pebbles(body, 0.08, filling);
      double             nearest = 1;
      for (std::size_t i = 0; i < packing.size(); ++i)
        {
          CHECK(body.depth(packing.centre[i]) >= 0.08 * (1 - 1e-8));
          for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, (packing.centre[i] - packing.centre[j]).norm());
        }
      CHECK(nearest == Approx(0.16).epsilon(1e-9));
      // Less a layer at the surface: 0.74 and 0.52 of it are solid.
      const double solid = 4.0 / 3.0 * M_PI * std::pow(0.08, 3) * static_cast<double>(packing.size());
      CHECK(solid / body.properties().volume > (filling == dem::Filling::close ? 0.5 : 0.36));
      CHECK(solid / body.properties().volume < (filling == dem::Filling::close ? 0.741 : 0.524));
      const dem::Specimen specimen = free_body(packing, in_space(2650));
      double              mass     = 0;
      for (std::size_t i = 0; i < packing.size(); ++i)
        mass += specimen.particle(i).mass;
      CHECK(mass == Approx(2650 * body.properties().volume).epsilon(1e-12));
      CHECK((specimen.clumps().state(0).position - Vector3d(3, 1, 2)).norm() < 1e-12);
    }
  CHECK_THROWS_WITH(dem::filled_with_pebbles(body, 0.9, dem::Filling::close), Contains("Take smaller ones"));
  CHECK_THROWS_WITH(dem::filled_with_pebbles(body, 1e-4, dem::Filling::close), Contains("more than ten million"));
}

TEST_CASE("a free prism of pebbles precesses as its own inertia says, not as theirs", "[dem][clumps]")
{
  // A symmetric top: its axis turns about the angular momentum at |L|/I_1, and keeps its angle with it.
  const double          a = 0.02, h = 0.05;
  const dem::ConvexBody prism(cuboid({a, a, h}), 3);
  const auto            packing = dem::filled_with_pebbles(prism, 0.0024, dem::Filling::close);
  dem::Specimen         body    = free_body(packing, in_space(2000));
  const double          mass = 2000 * a * a * h, I1 = mass * (a * a + h * h) / 12, I3 = mass * a * a / 6;
  const Vector3d        spin(40, 0, 200), velocity(0.1, 0.2, -0.3);
  set_motion(body, packing, velocity, spin);
  const Vector3d L(I1 * spin.x(), 0, I3 * spin.z());
  CHECK((body.clumps().state(0).angular_momentum - L).norm() < 1e-12 * L.norm());
  const double energy = body.energy().kinetic;
  CHECK(energy == Approx(0.5 * mass * velocity.squaredNorm() + 0.5 * spin.dot(L)).epsilon(1e-12));
  const double until = 3 * 2 * M_PI / (L.norm() / I1); // three turns of the axis
  const double dt    = std::min(body.time_step(), until / 20000);
  body.set_time_step(dt);
  while (body.time() < until)
    body.advance(1);
  const dem::ClumpState now  = body.clumps().state(0);
  const Vector3d        axis = now.turned * Vector3d::UnitZ();
  const Vector3d        wanted =
    Eigen::AngleAxisd(body.time() * L.norm() / I1, L.normalized()).toRotationMatrix() * Vector3d::UnitZ();
  CHECK((axis - wanted).norm() < 1e-4);
  CHECK((now.angular_momentum - L).norm() < 1e-12 * L.norm());
  CHECK(body.energy().kinetic == Approx(energy).epsilon(1e-6));
  CHECK((now.position - body.time() * velocity).norm() < 1e-9);
}

TEST_CASE("a rectangle of discs turns under a couple as the plate does", "[dem][clumps]")
{
  const dem::ConvexBody plate({{0, 0, 0}, {0.06, 0, 0}, {0.06, 0.02, 0}, {0, 0.02, 0}}, 2);
  const auto            packing = dem::filled_with_pebbles(plate, 0.003, dem::Filling::close);
  dem::Specimen         body    = free_body(packing, in_space(1500, 2));
  const double          mass = 1500 * 0.06 * 0.02 * 0.5, I = mass * (0.06 * 0.06 + 0.02 * 0.02) / 12;
  body.partners().add_force(0, Vector3d::Zero(), {0, 0, 1e-3});
  body.advance(1000);
  CHECK(body.clumps().state(0).spin.z() == Approx(1e-3 * body.time() / I).epsilon(1e-9));
  CHECK(body.energy().balance_error() < 1e-9);
  body.partners().clear_forces();
  const double spin = body.clumps().state(0).spin.z();
  body.advance(5000);
  CHECK(body.clumps().state(0).spin.z() == Approx(spin).epsilon(1e-12));
}
