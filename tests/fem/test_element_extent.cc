// Sizes of elements, as a softening law takes them.
#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/least_extent.h"
#include "fem/references/concrete_points.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace fem::references;

namespace
{
  using Eigen::Vector3d;

  fem::ElementExtent element(const std::vector<Vector3d> &vertices)
  {
    fem::ElementExtent extent;
    extent.mean_size = 1;
    for (const Vector3d &vertex : vertices)
      extent.vertices[extent.n_vertices++] = vertex;
    return extent;
  }

  fem::ElementExtent brick(const double x, const double y, const double z, const Eigen::Matrix3d &turned)
  {
    std::vector<Vector3d> vertices;
    for (int v = 0; v < 8; ++v)
      vertices.emplace_back(turned * Vector3d(x * (v & 1), y * (v >> 1 & 1), z * (v >> 2)));
    return element(vertices);
  }
}

TEST_CASE("the least extent of an element is its width across faces or edges, however it is turned", "[fem]")
{
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(fem::least_extent(brick(2, 1, 3, Eigen::Matrix3d::Identity())) == Approx(1));
  CHECK(fem::least_extent(brick(2, 1, 3, turned)) == Approx(1));
  // A regular tetrahedron of edge sqrt(2): narrowest across two opposite edges.
  CHECK(fem::least_extent(element({{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}})) == Approx(1));
  // In the plane: a square, and a right triangle of legs 3 and 4, narrowest across its hypotenuse.
  CHECK(fem::least_extent(element({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})) == Approx(1));
  CHECK(fem::least_extent(element({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}})) == Approx(2.4));
  CHECK(fem::least_extent(fem::ElementExtent::uniform(0.3)) == 0.3);
}

TEST_CASE("a plane element that opens across its plane has its size in it", "[fem]")
{
  fem::DamagePlasticParameters p = material_m1();
  p.element_size                 = 0;
  const fem::DamagePlasticConcrete law(p);
  const fem::ElementExtent         square = element({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  fem::DamagePlasticState          state;
  for (int step = 1; step <= 200 && state.damage == 0; ++step)
    {
      base::Voigt strain = base::Voigt::Zero();
      strain.head<3>() << -1e-5 * step, -2e-5 * step, 6e-5 * step;
      state = law.evaluate(strain, state, square).trial;
    }
  REQUIRE(state.damage > 0);
  CHECK(state.size == Approx(1));
}
