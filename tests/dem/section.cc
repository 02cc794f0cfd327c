#include "dem/grips/section.h"

#include "clusters.h"
#include "dem/core/uniform_random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3;

  double section_of(const dem::Packing &packing, const int axis)
  {
    return dem::nominal_section({packing.centre, packing.radius}, axis);
  }

  /** Centres at random in a cylinder of 50 mm across and 100 mm high along an axis, spheres wholly inside. */
  dem::Packing cylinder(const int axis)
  {
    dem::UniformRandom random(7);
    dem::Packing       packing;
    while (packing.size() < 20000)
      {
        const double   reach = 25e-3 - r;
        const Vector3d x(reach * (2 * random() - 1), reach * (2 * random() - 1), 100e-3 * random());
        if (x.head<2>().norm() > reach)
          continue;
        Vector3d turned;
        for (int c = 0; c < 3; ++c)
          turned[(axis + 1 + c) % 3] = x[c];
        packing.centre.push_back(turned);
        packing.radius.push_back(r);
      }
    return packing;
  }
} // namespace

TEST_CASE("nominal section of a box is its edges' product, radii included, along each axis", "[dem]")
{
  const dem::Packing box = cluster::cubic_lattice(5, 4, 3, r);
  CHECK(section_of(box, 0) == Approx(8 * 6 * r * r).epsilon(1e-12));
  CHECK(section_of(box, 1) == Approx(10 * 6 * r * r).epsilon(1e-12));
  CHECK(section_of(box, 2) == Approx(10 * 8 * r * r).epsilon(1e-12));
}

TEST_CASE("nominal section of a cylinder is its circle, not the square around it", "[dem]")
{
  for (const int axis : {0, 1, 2})
    {
      const dem::Packing body = cylinder(axis);
      CHECK(section_of(body, axis) ==
            Approx(M_PI * 25e-3 * 25e-3).epsilon(3e-3)); // drawn around the middle of the outermost spheres
      CHECK(section_of(body, (axis + 1) % 3) == Approx(50e-3 * 100e-3).epsilon(0.03));
    }
}

TEST_CASE("nominal section of one sphere is its circle, and of discs their extent times the thickness", "[dem]")
{
  CHECK(section_of(cluster::cubic_lattice(1, 1, 1, r), 2) == Approx(M_PI * r * r).epsilon(1e-12));
  const double                t      = 3e-3;
  const std::vector<Vector3d> centre = {{0, 0, 0}, {5 * r, 0, 0}, {0, 9 * r, 0}};
  const std::vector<double>   radius = {r, 2 * r, 3 * r};
  CHECK(dem::nominal_section({centre, radius, 2, t}, 1) == Approx(10 * r * t).epsilon(1e-12)); // x from -3 r to 7 r
  CHECK(dem::nominal_section({centre, radius, 2, t}, 0) == Approx(14 * r * t).epsilon(1e-12)); // y from -2 r to 12 r
}
