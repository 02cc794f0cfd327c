#include "base/errors.h"
#include "clusters.h"
#include "dem/laws/cpm.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/scaled_constants.h"
#include "dem/mesostructure/aggregate_sizes.h"
#include "dem/mesostructure/bodies_apart.h"
#include "dem/mesostructure/placement.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;
using Eigen::Vector3d;
using Kind = dem::AggregateShape::Kind;

namespace
{
  dem::AggregatePlacement in_cube(const double edge, const Kind kind = Kind::sphere)
  {
    dem::AggregatePlacement p;
    p.box        = Vector3d::Constant(edge);
    p.shape.kind = kind;
    if (kind != Kind::sphere)
      {
        p.shape.elongation = 0.8;
        p.shape.flatness   = 0.7;
      }
    return p;
  }

  /** Largest depth of points of one's surface in the other [m]; negative: none is inside. */
  double deepest(const dem::Inclusion &one, const dem::Inclusion &other)
  {
    dem::UniformRandom random(3);
    double             depth = -1;
    for (int k = 0; k < 200; ++k)
      depth = std::max(depth, other.depth(one.furthest(dem::random_rotation(random).col(0))));
    return depth;
  }

  /** Room between two bodies across a direction from one to the other, by how far each reaches [m]: no more than their distance. */
  double room_across(const Vector3d &direction, const dem::Inclusion &one, const dem::Inclusion &other)
  {
    return direction.dot(other.furthest(-direction) - one.furthest(direction));
  }

  /**
   * The most room across any direction: the distance of convex bodies. Sought at random, ever nearer to the best direction so far, so that what
   * is found is a distance that they have at least.
   */
  double distance(const dem::Inclusion &one, const dem::Inclusion &other, dem::UniformRandom &random)
  {
    Vector3d best = (other.centre - one.centre).normalized();
    double   most = room_across(best, one, other);
    for (double step = 0.5; step > 1e-7; step *= 0.97)
      for (int draw = 0; draw < 3; ++draw)
        {
          const Vector3d tried = (best + step * dem::random_rotation(random).col(0)).normalized();
          const double   room  = room_across(tried, one, other);
          if (room > most)
            {
              most = room;
              best = tried;
            }
        }
    return most;
  }

  /** All lie in the box as far from its faces as requested, and from each other; of a periodic box images count. */
  void check_clearance(const dem::Mesostructure &m, const dem::AggregatePlacement &p)
  {
    constexpr double   rounding = 1e-12, search = 1e-3; // of the box; of the gap
    dem::UniformRandom random(11);
    const auto        &all   = m.inclusions;
    const int          image = p.periodic ? 1 : 0;
    std::size_t        near  = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        if (!p.periodic)
          for (int d = 0; d < 3; ++d)
            {
              REQUIRE(all[i].furthest(Vector3d::Unit(d))[d] <= p.box[d] * (1 + rounding) - p.wall);
              REQUIRE(all[i].furthest(-Vector3d::Unit(d))[d] >= p.wall - rounding * p.box[d]);
            }
        for (std::size_t j = 0; j < i; ++j)
          for (int x = -image; x <= image; ++x)
            for (int y = -image; y <= image; ++y)
              for (int z = -image; z <= image; ++z)
                {
                  dem::Inclusion other = all[j];
                  for (int d = 0; d < 3 && p.periodic; ++d)
                    other.centre[d] -= p.box[d] * std::round((other.centre[d] - all[i].centre[d]) / p.box[d]);
                  other.centre += p.box.cwiseProduct(Vector3d(x, y, z));
                  const double gap     = std::max(p.clearance * (all[i].radius + other.radius), p.distance);
                  const double centres = (all[i].centre - other.centre).norm();
                  const double touch   = all[i].reach() + other.reach() + gap;
                  near += centres < 1.1 * touch ? 1 : 0;
                  if (p.shape.kind == Kind::sphere)
                    REQUIRE(centres >= touch * (1 - rounding));
                  else if (centres < touch)
                    {
                      REQUIRE(distance(all[i], other, random) >= gap * (1 - search));
                      REQUIRE(deepest(all[i], other) < 0);
                      REQUIRE(deepest(other, all[i]) < 0);
                    }
                }
      }
    CHECK(near > all.size() / 10); // it was put to the test
  }

  /** Whether two placements are the same to the last bit, shapes included. */
  bool same(const dem::Mesostructure &one, const dem::Mesostructure &other)
  {
    dem::UniformRandom random(7);
    bool               all = one.inclusions.size() == other.inclusions.size();
    for (std::size_t i = 0; all && i < one.inclusions.size(); ++i)
      {
        const Vector3d direction = dem::random_rotation(random).col(0);
        all                      = one.inclusions[i].centre == other.inclusions[i].centre &&
              one.inclusions[i].axes == other.inclusions[i].axes &&
              one.inclusions[i].furthest(direction) == other.inclusions[i].furthest(direction);
      }
    return all;
  }

  std::vector<double> fuller_sizes(const double content, const double edge)
  {
    return dem::sizes_for_volume(dem::GradingCurve::fuller(4e-3, 16e-3), 4e-3, content * edge * edge * edge).diameters;
  }
} // namespace

TEST_CASE("shapes: all have the volume of their sphere, support and depth of closed forms", "[dem][mesostructure]")
{
  const auto     body = dem::ellipsoid(0.5, 0.5);
  const Vector3d axes = Vector3d(1, 0.5, 0.25) / std::cbrt(0.125);
  for (int d = 0; d < 3; ++d)
    {
      CHECK_THAT(body->furthest(Vector3d::Unit(d))[d], WithinRel(axes[d], 1e-14));
      CHECK_THAT(body->depth(0.75 * axes[d] * Vector3d::Unit(d)),
                 WithinAbs(d == 2 ? 0.25 * axes[2] : body->depth(0.75 * axes[d] * Vector3d::Unit(d)), 1e-12));
    }
  CHECK_THAT(body->depth(Vector3d::Zero()), WithinRel(axes[2], 1e-9));
  CHECK_THAT(body->depth({1.5 * axes[0], 0, 0}), WithinRel(-0.5 * axes[0], 1e-9));
  // Along a normal from the surface: the place of the surface is the nearest one.
  dem::UniformRandom random(5);
  for (int k = 0; k < 50; ++k)
    {
      const Vector3d n = dem::random_rotation(random).col(1), x = body->furthest(n);
      CHECK_THAT(body->depth(x - 0.05 * n), WithinAbs(0.05, 1e-7));
      CHECK_THAT(body->depth(x + 0.3 * n), WithinAbs(-0.3, 1e-7));
    }
  // By counting of points: volumes are 4 pi/3.
  const auto stone = dem::random_polyhedron(12, 0.8, 0.7, random);
  for (const auto &shape : {body, stone})
    {
      std::size_t  inside = 0;
      const int    n      = 60;
      const double reach  = shape->reach();
      for (int i = 0; i < n * n * n; ++i)
        {
          const Vector3d place =
            Vector3d(i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5) * (2 * reach / n) - Vector3d::Constant(reach);
          inside += shape->depth(place) >= 0 ? 1 : 0;
        }
      CHECK_THAT(static_cast<double>(inside) * std::pow(2 * reach / n, 3), WithinRel(4.0 / 3 * M_PI, 0.01));
    }
}

TEST_CASE("separation: convex bodies are apart by what their closed forms say", "[dem][mesostructure]")
{
  dem::Inclusion one{dem::ellipsoid(0.5, 1), 1e-3, {0, 0, 0}, Eigen::Matrix3d::Identity()}, other = one;
  const double   longest = one.reach(), shortest = 0.5 * longest;
  other.axes   = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()).toRotationMatrix();
  other.centre = {longest + shortest + 1e-4, 0, 0};
  CHECK(dem::are_apart(one, other, 0.99e-4));
  CHECK_FALSE(dem::are_apart(one, other, 1.01e-4));
  CHECK(dem::are_apart(one, other, 0.99e-4 + 1e-3, {1e-3, 0, 0}));
  other.centre = {longest, 0, 0};
  CHECK_FALSE(dem::are_apart(one, other, 1e-6));
  const dem::Inclusion ball{dem::unit_sphere(), 1e-3, {2.1e-3, 0, 0}, Eigen::Matrix3d::Identity()};
  CHECK(dem::are_apart({dem::unit_sphere(), 1e-3, {0, 0, 0}, Eigen::Matrix3d::Identity()}, ball, 0.99e-4));
  CHECK_FALSE(dem::are_apart({dem::unit_sphere(), 1e-3, {0, 0, 0}, Eigen::Matrix3d::Identity()}, ball, 1.01e-4));
}

TEST_CASE("placement: 134 published aggregates lie wholly inside, apart by 5 % of their radii, the same for a seed",
          "[dem][mesostructure]")
{
  const dem::GradingCurve curve = dem::GradingCurve::of_passing(
    {{4.75e-3, 1122.0 / 1872}, {9.5e-3, 1422.0 / 1872}, {12.5e-3, 1722.0 / 1872}, {19e-3, 1}});
  const auto              sizes = dem::sizes_by_increment(curve, 4.75e-3, 12.8e-6).diameters;
  dem::AggregatePlacement p     = in_cube(0.05);
  const auto              first = dem::place_inclusions(sizes, p);
  CHECK_FALSE(first.grown);
  REQUIRE(first.structure.inclusions.size() == 134);
  CHECK_THAT(first.structure.content(), WithinRel(0.28307, 0.005));
  CHECK(p.clearance == 0.05);
  check_clearance(first.structure, p);
  CHECK(same(dem::place_inclusions(sizes, p).structure, first.structure));
  p.seed = 2;
  CHECK_FALSE(same(dem::place_inclusions(sizes, p).structure, first.structure));
}

TEST_CASE(
  "placement: every shape keeps its clearance, from faces and over those of a periodic box, the same for a seed",
  "[dem][mesostructure]")
{
  for (const Kind kind : {Kind::sphere, Kind::ellipsoid, Kind::polyhedron})
    for (const bool periodic : {false, true})
      {
        INFO(static_cast<int>(kind) << (periodic ? " periodic" : " between walls"));
        dem::AggregatePlacement p = in_cube(0.04, kind);
        p.periodic                = periodic;
        p.clearance               = 0.08;
        p.distance                = 0.5e-3; // more than the clearance of small ones
        p.wall                    = 0.7e-3;
        const auto sizes          = fuller_sizes(0.2, 0.04);
        const auto placed         = dem::place_inclusions(sizes, p);
        CHECK_FALSE(placed.grown);
        check_clearance(placed.structure, p);
        CHECK(same(dem::place_inclusions(sizes, p).structure, placed.structure));
        p.seed = 2;
        CHECK_FALSE(same(dem::place_inclusions(sizes, p).structure, placed.structure));
      }
}

TEST_CASE(
  "placement: what finds no place at random grows to its content, of every shape, between walls and in a periodic box",
  "[dem][mesostructure][slow]")
{
  const double edge = 0.04;
  const auto   grow = [&](const Kind kind, const bool periodic, const double content, const double clearance) {
    INFO(static_cast<int>(kind) << ' ' << periodic);
    dem::AggregatePlacement p = in_cube(edge, kind);
    p.periodic                = periodic;
    p.clearance               = clearance;
    p.tries                   = 20;
    p.restarts                = 0;
    const auto placed         = dem::place_inclusions(fuller_sizes(content, edge), p);
    CHECK(placed.grown);
    CHECK_THAT(placed.structure.content(), WithinAbs(content, 0.01));
    check_clearance(placed.structure, p);
  };
  grow(Kind::sphere, false, 0.5, 0.01);
  grow(Kind::sphere, true, 0.5, 0.01);
  grow(Kind::ellipsoid, true, 0.5, 0.01);
  grow(Kind::ellipsoid, false, 0.5, 0.01);
  grow(Kind::polyhedron, false, 0.4, 0.01);
  grow(Kind::polyhedron, true, 0.45, 0.01);
}

TEST_CASE("placement: what has no room is refused with the content that was reached", "[dem][mesostructure]")
{
  dem::AggregatePlacement p = in_cube(0.02);
  p.restarts                = 0;
  p.clearance               = 0.2;
  CHECK_THROWS_WITH(dem::place_inclusions(std::vector<double>(10, 0.8e-2), p), Contains("reached"));
  CHECK_THROWS_WITH(dem::place_inclusions({0.03}, p), Contains("larger than the specimen"));
  p.clearance = 0;
  CHECK_THROWS_WITH(dem::place_inclusions({0.01}, p), Contains("clearance"));
}

TEST_CASE("classification: particles lie in an aggregate by half their radius, links are of the class of their ends",
          "[dem][mesostructure]")
{
  dem::Mesostructure m;
  m.box        = Vector3d::Constant(0.02);
  m.inclusions = {{dem::unit_sphere(), 4e-3, {6e-3, 6e-3, 6e-3}, Eigen::Matrix3d::Identity()},
                  {dem::unit_sphere(), 3e-3, {14e-3, 6e-3, 6e-3}, Eigen::Matrix3d::Identity()}};
  dem::Packing two;
  two.centre = {
    {9.499e-3, 6e-3, 6e-3}, {9.501e-3, 6e-3, 6e-3}, {14e-3, 6e-3, 6e-3}, {6e-3, 6e-3, 6e-3}, {19e-3, 19e-3, 19e-3}};
  two.radius.assign(5, 1e-3);
  const std::vector<std::int32_t> of = dem::aggregates_of(m, two);
  CHECK(of == std::vector<std::int32_t>{0, dem::in_mortar, 1, 0, dem::in_mortar});
  CHECK(dem::link_class(of[0], of[3]) == dem::LinkClass::aggregate);
  CHECK(dem::link_class(of[0], of[1]) == dem::LinkClass::interface);
  CHECK(dem::link_class(of[0], of[2]) == dem::LinkClass::interface); // of two aggregates
  CHECK(dem::link_class(of[1], of[4]) == dem::LinkClass::mortar);
  // Points of elements and nodes have no size: they are inside up to the surface. In a periodic box images count.
  CHECK(dem::aggregates_at(m, two.centre)[1] == 0);
  m.periodic = true;
  CHECK(dem::aggregates_at(m, {{26e-3, -14e-3, 6e-3}})[0] == 0);
}

TEST_CASE("classification: aggregates with particles near each other have different numbers, as few as can be",
          "[dem][mesostructure]")
{
  // Four aggregates in a row of particles; the last is too far to be near any.
  dem::Packing              row;
  std::vector<std::int32_t> of;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k)
      {
        row.centre.push_back({(i == 3 ? 20e-3 : 4e-3 * i) + 2e-3 * k, 0, 0});
        row.radius.push_back(1e-3);
        of.push_back(i);
      }
  CHECK(dem::numbers_apart(row, of, 4, 1.5) == std::vector<std::int32_t>{0, 1, 0, 0});
  row.periodic_cell = Eigen::Vector3d(24e-3, 1, 1); // the last is the first one's neighbour, over the face
  CHECK(dem::numbers_apart(row, of, 4, 1.5) == std::vector<std::int32_t>{0, 1, 0, 1});
}

TEST_CASE("scaled constants: stiffness, strength and ductility of the interface from those of the mortar",
          "[dem][mesostructure]")
{
  const dem::CpmParameters mortar    = cluster::concrete();
  const auto               constants = dem::LinkLawKindOf<dem::CpmParameters::Law>::constants_of(mortar);
  struct Reading           final : dem::ConstantVisitor
  {
    std::map<std::string, double> read;
    void number(const char *key, double &value, const char *, const char *, double, double, bool) override
    {
      read[key] = value;
    }
    void choice(const char *,
                const std::vector<std::string> &,
                std::size_t,
                std::function<void(std::size_t)>,
                const char *) override
    {
    }
  };
  Reading interface, aggregate;
  dem::scaled(*constants, {0.5, 0.5, 0.1})->visit(interface);
  CHECK(interface.read["Normal modulus"] == 12.5e9);
  CHECK(interface.read["Cohesion"] == 1.5e6);
  CHECK(interface.read["Limit elastic strain"] == 1e-4);
  CHECK_THAT(interface.read["Relative ductility"], WithinRel(3.0, 1e-15));
  CHECK(interface.read["Shear ratio"] == 0.2);
  CHECK(interface.read["Friction coefficient"] == 0.8);
  dem::scaled(*constants, {2.5, 5, 1})->visit(aggregate);
  CHECK(aggregate.read["Normal modulus"] == 62.5e9);
  CHECK_THAT(aggregate.read["Limit elastic strain"], WithinRel(2e-4, 1e-15));
  CHECK(aggregate.read["Cohesion"] == 15e6);
  CHECK(aggregate.read["Relative ductility"] == 30);
  const auto contact =
    dem::LinkLawKindOf<dem::LinearContactParameters::Law>::constants_of(dem::LinearContactParameters());
  CHECK_THROWS_WITH(dem::scaled(*contact, {1, 1, 0.1}), Contains("no ductility"));
}
