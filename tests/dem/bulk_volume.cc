#include "dem/measures/bulk_volume.h"

#include "dem/core/uniform_random.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  struct Body
  {
    std::vector<Eigen::Vector3d> centre;
    std::vector<double>          radius, solid;

    void add(const Eigen::Vector3d &x, const double r)
    {
      centre.push_back(x);
      radius.push_back(r);
      solid.push_back(4.0 / 3.0 * M_PI * r * r * r);
    }
    double ratio() const { return dem::bulk_over_solid(centre, radius, solid, 3, 0); }
  };

  /** n^3 spheres of radius 1 in a cubic lattice of the given distance, each moved at random a little. */
  Body cube(const int n, const double distance)
  {
    dem::UniformRandom random(3);
    Body               body;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          {
            const Eigen::Vector3d stray(random() - 0.5, random() - 0.5, random() - 0.5);
            body.add(distance * Eigen::Vector3d(i, j, k) + 0.4 * stray, 1);
          }
    return body;
  }
} // namespace

TEST_CASE("bulk over solid volume is the reciprocal of the packing fraction inside, whatever the surface",
          "[dem][measures]")
{
  const double inside = std::pow(2.2, 3) / (4.0 / 3.0 * M_PI);
  Body         body   = cube(16, 2.2);
  // Balls of 2.5 diameters hold about 50 centres; their count scatters by a few, the mean over many by per cents.
  CHECK(body.ratio() == Approx(inside).epsilon(0.03));
  // A sparse crust, as a packing cut to a box has, would change the box around it by a third.
  for (const double x : {-4.0, 37.0})
    body.add({x, 16, 16}, 1);
  CHECK(body.ratio() == Approx(inside).epsilon(0.03));
}

TEST_CASE("bulk volume does not depend on the orientation of the body", "[dem][measures]")
{
  const Body            body = cube(14, 2.2);
  const Eigen::Matrix3d R    = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Body                  turned;
  for (std::size_t i = 0; i < body.centre.size(); ++i)
    turned.add(R * body.centre[i], 1);
  CHECK(turned.ratio() == Approx(body.ratio()).epsilon(1e-9));
}

TEST_CASE("small bodies get the box around them", "[dem][measures]")
{
  Body pair;
  pair.add({0, 0, 0}, 1);
  pair.add({2, 0, 0}, 1);
  CHECK(pair.ratio() == Approx(4.0 * 2 * 2 / (8.0 / 3.0 * M_PI)).epsilon(1e-12));
}
