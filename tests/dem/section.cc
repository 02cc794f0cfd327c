#include "dem/loading/section.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3;

  /** Columns of touching spheres along an axis: n spheres high, feet at the given places across (axis + 1, axis + 2). */
  std::vector<Vector3d> columns(const int axis, const int n, const std::vector<Eigen::Vector2d> &feet)
  {
    std::vector<Vector3d> centre;
    for (const auto &foot : feet)
      for (int k = 0; k < n; ++k)
        {
          Vector3d x;
          x[axis]           = 2 * r * k;
          x[(axis + 1) % 3] = foot[0];
          x[(axis + 2) % 3] = foot[1];
          centre.push_back(x);
        }
    return centre;
  }
} // namespace

namespace
{
  /** Area of the polygon with 24 corners on a circle that stands for it; its corners on the axes are those of the circle. */
  double polygon(const double radius) { return 12 * std::sin(2 * M_PI / 24) * radius * radius; }
} // namespace

TEST_CASE("section of a sphere is its full circle", "[dem]")
{
  for (const int axis : {0, 1, 2})
    {
      const double found = dem::smallest_section({Vector3d::Zero()}, {r}, axis, -0.6 * r, 0.6 * r);
      CHECK(found == Approx(polygon(r)).epsilon(1e-12));
      CHECK(found == Approx(M_PI * r * r).epsilon(0.0115)); // what a polygon of 24 corners lacks
    }
}

TEST_CASE("section of a rectangle of columns is the hull of their circles", "[dem]")
{
  // Hull of equal circles: area of the centres' hull + its perimeter r + one circle, the voids inside counted.
  const double                       a = 7 * r, b = 4 * r;
  const std::vector<Eigen::Vector2d> feet = {{0, 0}, {a, 0}, {a, b}, {0, b}, {0.4 * a, 0.3 * b}};
  for (const int axis : {0, 1, 2})
    {
      const auto                centre = columns(axis, 3, feet);
      const std::vector<double> radius(centre.size(), r);
      CHECK(dem::smallest_section(centre, radius, axis, -0.3 * r, 4.3 * r) ==
            Approx(a * b + 2 * (a + b) * r + polygon(r)).epsilon(1e-12));
    }
}

TEST_CASE("section finds the waist of a body", "[dem]")
{
  // A wide foot, a single column, a wide head: the section is that of the column.
  std::vector<Vector3d> centre = columns(2, 11, {{0, 0}});
  for (const double z : {0.0, 20 * r})
    for (const double x : {-4 * r, 4 * r})
      centre.push_back({x, x, z});
  const std::vector<double> radius(centre.size(), r);
  CHECK(dem::smallest_section(centre, radius, 2, 0, 20 * r) == Approx(polygon(r)).epsilon(1e-12));
  CHECK(dem::smallest_section(centre, radius, 2, -0.5 * r, 0.5 * r) > 16 * r * r);
}

TEST_CASE("section of discs is their extent times the thickness", "[dem]")
{
  const double                t      = 3e-3;
  const std::vector<Vector3d> centre = {{0, 0, 0}, {5 * r, 0, 0}, {0, 9 * r, 0}};
  const std::vector<double>   radius = {r, 2 * r, 3 * r};
  CHECK(dem::smallest_plane_section(centre, radius, 1, -0.5 * r, 0.5 * r, t) == Approx(8 * r * t).epsilon(1e-12));
  CHECK(dem::smallest_plane_section(centre, radius, 0, 4 * r, 6 * r, t) == Approx(4 * r * t).epsilon(1e-12));
}

TEST_CASE("section between particles that no plane meets is infinite", "[dem]")
{
  const std::vector<Vector3d> centre = {{0, 0, 0}, {0, 0, 10 * r}};
  CHECK(std::isinf(dem::smallest_section(centre, {r, r}, 2, 2 * r, 8 * r)));
  CHECK(dem::smallest_section(centre, {r, r}, 2, 0, 10 * r) ==
        Approx(polygon(r)).epsilon(1e-12)); // planes in the gap do not count
}
