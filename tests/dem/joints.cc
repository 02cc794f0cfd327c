// Joints through a packing: doc/theory/smooth-joint.md, 4 and 5.
#include "base/errors.h"
#include "clusters.h"
#include "dem/joints/joint_cuts.h"
#include "dem/joints/joint_network.h"
#include "dem/packing/lattice.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace
{
  bool meets(const dem::JointPlane &joint, const Vector3d &one, const Vector3d &other, const int dimension)
  {
    Vector3d at;
    return dem::crosses(joint, one, other, dimension, at);
  }
} // namespace

TEST_CASE("a line crosses a joint within its extent only, at the place of closed cases", "[dem][joints]")
{
  dem::JointPlane plane;
  plane.centre = {0, 0, 0.3};
  plane.normal = {0, 0, 1};
  Vector3d at;
  REQUIRE(dem::crosses(plane, {1, 2, 0}, {3, 4, 1.2}, 3, at));
  CHECK((at - Vector3d(1.5, 2.5, 0.3)).norm() < 1e-15);
  CHECK_FALSE(meets(plane, {1, 2, 0.4}, {3, 4, 1.2}, 3));
  CHECK(meets(plane, {1, 2, 0.3}, {3, 4, 0.2}, 3)); // a place on it is on the side of its normal
  CHECK_FALSE(meets(plane, {1, 2, 0.3}, {3, 4, 0.4}, 3));
  plane.radius = 1;
  CHECK(meets(plane, {0.6, 0.7, 0}, {0.6, 0.7, 1}, 3));
  CHECK_FALSE(meets(plane, {0.8, 0.7, 0}, {0.8, 0.7, 1}, 3));

  // An L: its notch is no part of it.
  const dem::JointPlane polygon =
    dem::polygon_joint({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  CHECK(meets(polygon, {0.5, 1.5, -1}, {0.5, 1.5, 1}, 3));
  CHECK(meets(polygon, {1.5, 0.5, 1}, {1.5, 0.5, -1}, 3));
  CHECK_FALSE(meets(polygon, {1.5, 1.5, -1}, {1.5, 1.5, 1}, 3));

  const dem::JointPlane segment = dem::segment_joint({0, 0, 0}, {1, 1, 0});
  CHECK(meets(segment, {0, 1, 0}, {1, 0, 0}, 2));
  CHECK(meets(segment, {1, 0, 0}, {0, 1, 0}, 2));
  CHECK_FALSE(meets(segment, {1, 2, 0}, {2, 1, 0}, 2));
  CHECK_THROWS_AS(dem::segment_joint({1, 1, 0}, {1, 1, 0}), base::InputError);
  CHECK_THROWS_WITH(dem::polygon_joint({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}}),
                    Contains("does not lie on the plane"));
  CHECK_THROWS_AS(dem::polygon_joint({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), base::InputError);
}

TEST_CASE("extent of joints in a box is that of closed cases", "[dem][joints]")
{
  const Vector3d  low(0, 0, 0), high(1, 2, 3);
  dem::JointPlane joint;
  joint.centre = {0.5, 1, 1.5};
  joint.normal = {0, 0, 1};
  CHECK(dem::extent_in_box(joint, low, high, 3) == Approx(2));
  joint.normal = Vector3d(1, 1, 0).normalized();
  joint.centre = {0.5, 0.5, 0};
  CHECK(dem::extent_in_box(joint, low, high, 3) == Approx(3 * std::sqrt(2)));
  CHECK(dem::extent_in_box(joint, low, high, 2) == Approx(std::sqrt(2)));
  joint.radius = 0.25;
  joint.centre = {0.5, 0.5, 1};
  CHECK(dem::extent_in_box(joint, low, high, 3) == Approx(M_PI / 16));
  joint.centre = {0.5, 0.5, 0};
  CHECK(dem::extent_in_box(joint, low, high, 3) == Approx(M_PI / 32));
  joint.centre = {5, 5, 5};
  CHECK(dem::extent_in_box(joint, low, high, 3) == 0);
  CHECK(dem::extent_in_box(dem::segment_joint({-1, 1, 0}, {3, 1, 0}), low, high, 2) == Approx(1));
}

TEST_CASE("dips turn normals as geologists count them", "[dem][joints]")
{
  CHECK((dem::normal_of_dip(0, 70, 3) - Vector3d(0, 0, 1)).norm() < 1e-15);
  CHECK((dem::normal_of_dip(90, 90, 3) - Vector3d(0, 1, 0)).norm() < 1e-15);
  const Vector3d n = dem::normal_of_dip(30, 0, 3), steepest(std::cos(M_PI / 6), 0, -std::sin(M_PI / 6));
  CHECK(std::abs(n.dot(steepest)) < 1e-15);
  CHECK(std::abs(dem::normal_of_dip(30, 0, 2).dot(Vector3d(std::cos(M_PI / 6), std::sin(M_PI / 6), 0))) < 1e-15);
}

TEST_CASE("a joint through a lattice cuts the links that cross it, which share its area", "[dem][joints]")
{
  // Rows of 10 by 8 (by 6) particles that touch: a plane between the fourth row and the fifth.
  const double r = 1e-3;
  for (const int dimension : {2, 3})
    {
      dem::Packing packing;
      for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 8; ++j)
          for (int k = 0; k < (dimension == 2 ? 1 : 6); ++k)
            {
              packing.centre.emplace_back(2 * r * i, 2 * r * j, 2 * r * k);
              packing.radius.push_back(r);
            }
      dem::JointPlane plane;
      plane.centre      = {0, 7 * r, 0};
      const auto   cuts = dem::find_cuts(packing, {dimension, 0.02, 1.1, 0, packing.size()}, {plane});
      const double area = dimension == 2 ? 0.02 * 20 * r : 20 * r * 12 * r;
      CHECK(cuts.of_joint[0].links == (dimension == 2 ? 10 : 60));
      CHECK(cuts.of_joint[0].area == Approx(area));
      CHECK(std::is_sorted(cuts.cuts.begin(), cuts.cuts.end()));
      CHECK(cuts.cuts.size() > cuts.of_joint[0].links); // others may come near
      double sum = 0;
      for (const dem::JointCut &cut : cuts.cuts)
        {
          const Vector3d &a = packing.centre[static_cast<std::size_t>(cut.first)],
                         &b = packing.centre[static_cast<std::size_t>(cut.second)];
          CHECK((a.y() < 7 * r) != (b.y() < 7 * r));
          if ((a - b).norm() < 2.2 * r)
            sum += cut.area;
        }
      CHECK(sum == Approx(area));
    }
}

TEST_CASE("of a pair that several joints cut the first one has it", "[dem][joints]")
{
  dem::Packing packing;
  packing.centre = {{0, 0, 0}, {2e-3, 0, 0}};
  packing.radius = {1e-3, 1e-3};
  std::vector<dem::JointPlane> joints(2);
  joints[0].centre = joints[1].centre = {1e-3, 0, 0};
  joints[0].normal                    = {1, 0, 0};
  joints[1].normal                    = Vector3d(1, 1, 0).normalized();
  const auto cuts                     = dem::find_cuts(packing, {3, 0, 1.1, 0, 2}, joints);
  REQUIRE(cuts.cuts.size() == 1);
  CHECK(cuts.cuts[0].joint == 0);
  CHECK(cuts.of_joint[0].links == 1);
  CHECK(cuts.of_joint[1].links == 0);
  CHECK(dem::find_cuts(packing, {3, 0, 1.1, 0, 1}, joints).cuts.empty());
}

TEST_CASE("a joint all through an upright body has the section over the cosine of its dip, however steep it is",
          "[dem][joints]")
{
  const double r        = 1e-3;
  double       of_round = 0; // section of a cylinder of spheres, whose skin is rough
  for (const int dimension : {2, 3})
    for (const double dip : {0.0, 30.0, 50.0, 65.0, 72.0})
      {
        INFO(dimension << " dimensions, dip " << dip);
        dem::Packing body =
          dem::make_lattice(dimension == 2 ? dem::Lattice::hexagonal : dem::Lattice::face_centred_cubic, r,
                            dimension == 2 ? std::array<int, 3>{24, 70, 1} : std::array<int, 3>{9, 9, 40});
        body.periodic_cell.reset();
        const int    axis = dimension - 1;
        Vector3d     low = body.centre.front(), high = low, middle = Vector3d::Zero();
        dem::Packing round; // of the body in space a cylinder
        for (const Vector3d &each : body.centre)
          {
            low = low.cwiseMin(each), high = high.cwiseMax(each);
            middle += each / static_cast<double>(body.size());
          }
        low -= Vector3d::Constant(r), high += Vector3d::Constant(r);
        const double radius = 0.5 * (high - low).x();
        for (std::size_t i = 0; i < body.size(); ++i)
          if ((body.centre[i] - middle).head(axis).norm() <= radius - r)
            {
              round.centre.push_back(body.centre[i]);
              round.radius.push_back(r);
            }
        dem::JointPlane plane;
        plane.centre       = middle;
        plane.normal       = dem::normal_of_dip(dip, 20, dimension);
        const auto area_of = [&](const dem::Packing &packing) {
          return dem::find_cuts(packing, {dimension, 1, 1.1, 0, packing.size()}, {plane}).of_joint[0].area *
                 std::cos(dip * M_PI / 180);
        };
        const Vector3d edge = high - low;
        CHECK(area_of(body) == Approx(dimension == 2 ? edge.x() : edge.x() * edge.y()).epsilon(0.03));
        if (dimension == 3)
          {
            of_round = dip == 0 ? area_of(round) : of_round;
            CHECK(area_of(round) ==
                  Approx(of_round).epsilon(0.05)); // another section of a lattice is rough in another way
          }
      }
}

TEST_CASE("random joints come to the prescribed intensity, and to Fisher's mean direction", "[dem][joints]")
{
  dem::JointNetwork network;
  network.upper     = {1, 1, 1};
  network.radius    = 0.1;
  network.intensity = 60;
  network.normal    = Vector3d(1, 2, 2) / 3;
  for (const int dimension : {2, 3})
    for (const double kappa : {0.0, 3.0, 40.0})
      {
        network.dimension     = dimension;
        network.concentration = kappa;
        network.normal        = dimension == 2 ? Vector3d(0.6, 0.8, 0) : Vector3d(1, 2, 2) / 3;
        const auto joints     = dem::random_joints(network);
        double     sum        = 0;
        Vector3d   resultant  = Vector3d::Zero();
        double     worst      = 0;
        for (const dem::JointPlane &joint : joints)
          {
            sum += dem::extent_in_box(joint, network.lower, network.upper, dimension);
            resultant += joint.normal / static_cast<double>(joints.size());
            worst = std::max(worst, std::abs(joint.normal.norm() - 1));
          }
        CHECK(worst < 1e-12);
        CHECK(std::abs(sum - network.intensity) <= 0.5 * (dimension == 2 ? 0.2 : M_PI * 0.01) + 1e-12);
        // Mean resultant length: coth k - 1/k on the sphere, I_1/I_0 on the circle; scatter of a mean of so many.
        const double expected = kappa == 0     ? 0.0 :
                                dimension == 3 ? 1 / std::tanh(kappa) - 1 / kappa :
                                                 std::cyl_bessel_i(1, kappa) / std::cyl_bessel_i(0, kappa);
        CHECK(resultant.dot(network.normal) ==
              Approx(expected).margin(4 / std::sqrt(static_cast<double>(joints.size()))));
        const auto again = dem::random_joints(network);
        REQUIRE(again.size() == joints.size());
        CHECK(again.back().centre == joints.back().centre);
        CHECK(again.back().normal == joints.back().normal);
      }
  network.concentration = std::numeric_limits<double>::infinity();
  CHECK(dem::random_joints(network).front().normal == network.normal);
  network.seed     = 2;
  const auto other = dem::random_joints(network);
  network.seed     = 1;
  CHECK(other.front().centre != dem::random_joints(network).front().centre);
  network.intensity = 0;
  CHECK_THROWS_WITH(dem::random_joints(network), Contains("intensity = 0"));
  network.intensity = 1e9;
  CHECK_THROWS_WITH(dem::random_joints(network), Contains("more than"));
}
