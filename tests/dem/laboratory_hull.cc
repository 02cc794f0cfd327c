// The hull of a body of particles and the membrane on it: doc/theory/laboratory.md, 4.
#include "clusters.h"
#include "dem/laboratory/hull.h"
#include "dem/laboratory/membrane.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/lattice.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>

using Eigen::Vector3d;

namespace
{
  constexpr double R = 1e-3;

  dem::Packing crystal(const int columns, const int rows)
  {
    dem::Packing packing = dem::make_lattice(dem::Lattice::hexagonal, R, {columns, rows, 1});
    packing.periodic_cell.reset();
    return packing;
  }

  /** Discs shaken out of a crystal, of several sizes, within a circle. */
  dem::Packing shaken_discs(const std::uint64_t seed)
  {
    dem::UniformRandom random(seed);
    dem::Packing       found;
    for (const Vector3d &x : crystal(16, 10).centre)
      {
        const double   radius = R * (0.6 + 0.4 * random());
        const Vector3d shift  = cluster::random_vector(random);
        if ((x - Vector3d(16 * R, 17 * R, 0)).norm() > 13 * R)
          continue;
        found.centre.push_back(x + 0.3 * R * Vector3d(shift.x(), shift.y(), 0));
        found.radius.push_back(radius);
      }
    return found;
  }

  /** Sums of area vectors and of their moments, and what they enclose. */
  struct Sums
  {
    Vector3d area = Vector3d::Zero(), moment = Vector3d::Zero();
    double   size = 0, enclosed = 0;
  };

  Sums sums_of(const dem::Hull &hull, const std::vector<Vector3d> &centre)
  {
    Sums sums;
    for (std::size_t f = 0; f < hull.facet.size(); ++f)
      {
        const Vector3d a      = hull.area_vector(f, centre);
        Vector3d       middle = Vector3d::Zero();
        for (int c = 0; c < hull.corners; ++c)
          middle += centre[static_cast<std::size_t>(hull.facet[f][static_cast<std::size_t>(c)])] / hull.corners;
        sums.area += a;
        sums.moment += middle.cross(a);
        sums.size += a.norm();
        sums.enclosed += middle.dot(a) / hull.corners;
      }
    return sums;
  }

  /** Every edge of a facet is that of another, the other way round. */
  bool closed(const dem::Hull &hull)
  {
    std::map<std::array<std::int32_t, 2>, int> edges;
    const auto                                 corners = static_cast<std::size_t>(hull.corners);
    for (const auto &facet : hull.facet)
      {
        if (corners == 2)
          {
            ++edges[{facet[0], 0}];
            --edges[{facet[1], 0}];
            continue;
          }
        for (std::size_t c = 0; c < 3; ++c)
          {
            ++edges[{facet[c], facet[(c + 1) % 3]}];
            --edges[{facet[(c + 1) % 3], facet[c]}];
          }
      }
    for (const auto &[edge, more] : edges)
      if (more != 0)
        return false;
    return !hull.facet.empty();
  }
} // namespace

TEST_CASE("hull of a plane crystal is the chain of its outermost discs, holes or not", "[dem][laboratory]")
{
  dem::Packing    packing = crystal(8, 5);
  const dem::Hull hull    = dem::find_hull(packing.centre, packing.radius, 2, 0.3 * R);
  CHECK(closed(hull));
  // Rows of eight, ten of them: two whole rows and the ends of eight.
  std::set<std::int32_t> outermost;
  for (const auto &facet : hull.facet)
    outermost.insert(facet[0]);
  CHECK(outermost.size() == 2 * 8 + 2 * 8);
  CHECK(hull.facet.size() == outermost.size());

  // A disc of the middle less: the ball cannot come in.
  std::size_t inner = 0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    if ((packing.centre[i] - Vector3d(8 * R, 9 * R, 0)).norm() <
        (packing.centre[inner] - Vector3d(8 * R, 9 * R, 0)).norm())
      inner = i;
  const double before = sums_of(hull, packing.centre).enclosed;
  packing.centre.erase(packing.centre.begin() + static_cast<std::ptrdiff_t>(inner));
  packing.radius.pop_back();
  const dem::Hull holed = dem::find_hull(packing.centre, packing.radius, 2, 0.3 * R);
  CHECK(sums_of(holed, packing.centre).enclosed == Approx(before).epsilon(1e-12));
}

TEST_CASE("pressure on a closed hull has neither resultant nor moment, and the hull encloses the body",
          "[dem][laboratory]")
{
  for (const int dimension : {2, 3})
    for (const double ball : {0.7, 1.0, 3.0})
      for (const std::uint64_t seed : {1, 2, 3})
        {
          const dem::Packing packing =
            dimension == 3 ? cluster::random_cluster(seed, 150, 0.6 * R, R) : shaken_discs(seed);
          const dem::Hull hull = dem::find_hull(packing.centre, packing.radius, dimension, ball * R);
          INFO("dimension " << dimension << ", ball " << ball << ", seed " << seed << ", facets " << hull.facet.size());
          REQUIRE(closed(hull));
          const Sums sums = sums_of(hull, packing.centre);
          CHECK(sums.area.norm() < 1e-12 * sums.size);
          CHECK(sums.moment.norm() < 1e-12 * sums.size * 10 * R);
          double solid = 0;
          for (const double r : packing.radius)
            solid += dimension == 2 ? M_PI * r * r : 4.0 / 3 * M_PI * r * r * r;
          CHECK(sums.enclosed > 0.15 * solid); // of the centres alone: less than the body, and never inside out
        }
}

TEST_CASE("hull of a cubic crystal holds where a ball touches four spheres at once", "[dem][laboratory]")
{
  const dem::Packing packing = cluster::cubic_lattice(4, 5, 6, R);
  const dem::Hull    hull    = dem::find_hull(packing.centre, packing.radius, 3, 1.0 * R);
  CHECK(closed(hull));
  CHECK(sums_of(hull, packing.centre).enclosed == Approx(6 * 8 * 10 * R * R * R).epsilon(1e-9));
  CHECK(sums_of(hull, packing.centre).size == Approx(2 * (6 * 8 + 8 * 10 + 6 * 10) * R * R).epsilon(1e-9));
}

TEST_CASE("a ball finds no way around a single particle", "[dem][laboratory]")
{
  CHECK(dem::find_hull({Vector3d::Zero()}, {R}, 2, R).facet.empty());
  CHECK(dem::find_hull({Vector3d::Zero()}, {R}, 3, R).facet.empty());
}

TEST_CASE("membrane between platens presses either half with the pressure times its height", "[dem][laboratory]")
{
  dem::ParallelBondParameters law;
  law.effective_modulus = 1e9;
  law.tensile_strength = law.cohesion = 1e6;
  for (const int dimension : {2, 3})
    {
      dem::SpecimenParameters p  = cluster::next_neighbours();
      p.physics.dimension        = dimension;
      p.thickness                = dimension == 2 ? 0.5 : 0;
      const dem::Packing packing = dimension == 2 ? crystal(6, 8) : cluster::cubic_lattice(5, 6, 9, R);
      dem::Specimen      body(packing, p, law);
      const int          axis = dimension - 1;
      double             low = 1, high = -1;
      for (const Vector3d &x : packing.centre)
        {
          low  = std::min(low, x[axis] - R);
          high = std::max(high, x[axis] + R);
        }
      const dem::EndPlanes ends{axis, low, high};
      dem::Membrane        membrane(body, R);
      membrane.lay(ends);
      const double pressure = 1e5;
      Vector3d     sum = Vector3d::Zero(), half = Vector3d::Zero();
      double       middle = dimension == 2 ? 6 * R : 4 * R, size = 0;
      for (const auto &push : membrane.pushes(pressure, ends))
        {
          sum += push.force;
          size += push.force.norm();
          if (packing.centre[push.particle].x() > middle)
            half += push.force;
        }
      sum[axis] = 0; // along the axis the platens are there
      CHECK(sum.norm() < 1e-12 * size);
      const double depth = dimension == 2 ? p.thickness : 10 * R;
      if (dimension == 2)
        CHECK(half.x() == Approx(-pressure * (high - low) * depth).epsilon(0.02));
      else // the outermost quadrilaterals end at the centres: five rows of six
        CHECK(half.x() == Approx(-pressure * (high - low) * 10 * R).epsilon(0.02));

      // It is work from outside, and the account knows it.
      for (int i = 0; i < 200; ++i)
        {
          body.partners().clear_forces();
          membrane.push(pressure, ends);
          body.advance(1);
        }
      CHECK(body.energy().external_work > 0);
      CHECK(body.energy().balance_error() < 1e-3);
    }
}
