#include "base/errors.h"
#include "dem/model/packing.h"
#include "dem/packing/overlaps.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace
{
  dem::Packing two_spheres()
  {
    dem::Packing packing;
    packing.centre = {{0.0, 0.0, 0.0}, {0.003, 0.0, 0.0}};
    packing.radius = {0.001, 0.002};
    return packing;
  }
} // namespace

TEST_CASE("solid volume of spheres is that of Archimedes", "[dem][packing]")
{
  // 4/3 pi (1^3 + 2^3) mm^3 = 12 pi mm^3; rounding of a few operations.
  REQUIRE(dem::solid_volume(two_spheres()) == Approx(12e-9 * std::acos(-1.0)).epsilon(1e-14));
  REQUIRE(dem::solid_volume({}) == 0.0);
}

TEST_CASE("a sound packing passes the check", "[dem][packing]")
{
  dem::Packing packing = two_spheres();
  REQUIRE_NOTHROW(dem::check_packing(packing, "a.txt"));
  packing.periodic_cell = Eigen::Vector3d(0.01, 0.01, std::numeric_limits<double>::infinity());
  REQUIRE_NOTHROW(dem::check_packing(packing, "a.txt"));
}

TEST_CASE("a packing without particles, or with columns that do not fit, is refused by file", "[dem][packing]")
{
  using Catch::Contains;
  dem::Packing packing = two_spheres();
  const auto   refusal = [&packing] { dem::check_packing(packing, "a.txt"); };

  SECTION("no particle")
  {
    packing = {};
    REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: no particle"));
  }
  SECTION("pebbles of bodies that nothing is said of")
  {
    packing.clump = {0, 0};
    REQUIRE_THROWS_WITH(refusal(), Contains("# body VOLUME X Y Z IXX IYY IZZ IYZ IXZ IXY"));
    packing.clump = {-1, -1};
    REQUIRE_NOTHROW(refusal());
  }
  SECTION("columns of unequal length")
  {
    packing.radius.pop_back();
    REQUIRE_THROWS_WITH(refusal(), Contains("2 centres but 1 radii"));
  }
  SECTION("as an input error, which the program answers with exit status 2")
  {
    packing = {};
    REQUIRE_THROWS_AS(refusal(), base::InputError);
  }
}

TEST_CASE("centres that are no places, or too far out to be distinguished, are refused by file and particle",
          "[dem][packing]")
{
  using Catch::Contains;
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  dem::Packing packing = two_spheres();
  const auto   refusal = [&packing] { dem::check_packing(packing, "a.txt"); };

  SECTION("a centre that is not a number")
  {
    packing.centre[1][2] = nan;
    REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: particle 2: centre = (0.003, 0, nan)"));
    packing.centre[1][2] = std::numeric_limits<double>::infinity();
    REQUIRE_THROWS_WITH(refusal(), Contains("centre = (0.003, 0, inf)"));
  }
  SECTION("a centre so far out that distances overflow")
  {
    packing.centre[0][0] = -1e308;
    packing.centre[1][0] = 1e308;
    REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: particle 1: centre = (-1e+308, 0, 0)") && Contains("1e100 m"));
    packing.centre[0][0] = -1e100;
    packing.centre[1][0] = 1e100;
    REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: particle 1: ") && Contains("more than 1e9 radii from the origin"));
  }
  SECTION("a centre so far out that the digits of its place do not distinguish it from its neighbours")
  {
    packing.centre[1][0] = 1.9e6;
    REQUIRE_NOTHROW(refusal());
    packing.centre[1][0] = 2.1e6;
    REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: particle 2: ") && Contains("more than 1e9 radii from the origin"));
  }
  SECTION("a centre many periodic cells away")
  {
    packing.periodic_cell = Eigen::Vector3d(0.01, 0.01, 0.01);
    packing.centre[1][2]  = -0.59;
    REQUIRE_NOTHROW(dem::check_in_cell(packing, "a.txt"));
    packing.centre[1][2] = -0.61;
    REQUIRE_THROWS_WITH(dem::check_in_cell(packing, "a.txt"),
                        Contains("a.txt: particle 2: ") && Contains("more than 60 periodic cells"));
  }
}

TEST_CASE("radii that make no sphere are refused by file and particle", "[dem][packing]")
{
  using Catch::Contains;
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  dem::Packing packing = two_spheres();
  const auto   refusal = [&packing] { dem::check_packing(packing, "a.txt"); };

  SECTION("radii whose volume is not a number or vanishes")
  {
    for (const double radius : {1e-320, 1e200})
      {
        packing.radius[1] = radius;
        REQUIRE_THROWS_WITH(refusal(), Contains("particle 2: radius = ") && Contains("1e-100 to 1e100 m"));
      }
  }
  SECTION("radii that are not above zero")
  {
    for (const double radius : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
      {
        packing.radius[0] = radius;
        REQUIRE_THROWS_WITH(refusal(), Contains("particle 1: radius = ") && Contains("above zero"));
      }
  }
}

TEST_CASE("centres that coincide, and cells without extent, are refused by file and particle", "[dem][packing]")
{
  using Catch::Contains;
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  dem::Packing packing = two_spheres();
  const auto   refusal = [&packing] { dem::check_packing(packing, "a.txt"); };

  SECTION("coincident centres")
  {
    packing.centre[1] = packing.centre[0];
    REQUIRE_THROWS_WITH(refusal(), Contains("particle 2") && Contains("same place as particle 1."));
  }
  SECTION("centres that coincide across the periodic cell")
  {
    packing.periodic_cell = Eigen::Vector3d(0.003, 0.01, 0.01);
    REQUIRE_THROWS_WITH(refusal(), Contains("particle 2") && Contains("particle 1 (its periodic image)"));
  }
  SECTION("a periodic cell without extent")
  {
    for (const double edge : {0.0, -0.01, nan})
      {
        packing.periodic_cell = Eigen::Vector3d(0.01, edge, 0.01);
        REQUIRE_THROWS_WITH(refusal(), Contains("periodic cell") && Contains("above zero"));
      }
  }
}

TEST_CASE("particles that overlap by almost a diameter are refused, and those of a dense packing are not",
          "[dem][packing]")
{
  using Catch::Contains;
  dem::Packing packing  = two_spheres(); // radii 1 and 2 mm
  const auto   refusal  = [&packing] { dem::check_overlaps(packing, "a.txt", 3); };
  packing.centre[1].x() = 0.0016; // overlap 1.4 mm of 2 mm
  REQUIRE_NOTHROW(refusal());
  packing.centre[1].x() = 0.0014;
  REQUIRE_THROWS_WITH(refusal(), Contains("a.txt: particles 1 and 2 overlap") && Contains("80 %"));
  packing.centre[1].x() = 0.0101; // the images are as near
  packing.periodic_cell = Eigen::Vector3d(0.0115, 0.02, 0.02);
  REQUIRE_THROWS_WITH(refusal(), Contains("particles 1 and 2 (its periodic image) overlap"));
}

TEST_CASE("a packing that is larger than its periodic cell is refused", "[dem][packing]")
{
  using Catch::Contains;
  dem::Packing packing  = two_spheres();
  packing.centre[1].x() = 0.05;
  packing.periodic_cell = Eigen::Vector3d(0.04, 0.04, 0.04);
  REQUIRE_THROWS_WITH(dem::check_overlaps(packing, "a.txt", 3),
                      Contains("a.txt: along x the centres lie up to 0.05 m apart") && Contains("0.04 m long"));
  packing.centre[1].x() = 0.0439; // a particle across the boundary may stand on either side
  REQUIRE_NOTHROW(dem::check_overlaps(packing, "a.txt", 3));
  packing.centre[1]     = {0.0005, 0.0005, 0.0025};
  packing.periodic_cell = Eigen::Vector3d(0.0033, 0.0033, 0.0033); // 37.7 mm^3 of spheres in 35.9 mm^3
  REQUIRE_THROWS_WITH(dem::check_overlaps(packing, "a.txt", 3), Contains("a volume of"));
}
