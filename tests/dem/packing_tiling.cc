#include "base/errors.h"
#include "dem/packing/lattice.h"
#include "dem/packing/tiling.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using Catch::Contains;

TEST_CASE("a simple cubic lattice fills a box of whole cells to the last sphere", "[dem][packing]")
{
  // Every sphere touches a face or the next sphere: only round-off decides, in sizes that are no binary numbers.
  for (const double radius : {1.0, 0.1, 1e-3, 0.7e-3})
    {
      const dem::Packing cell   = dem::make_lattice(dem::Lattice::simple_cubic, radius, {{3, 3, 3}});
      const dem::Tiling  tiling = dem::tile_and_crop(cell, 2 * radius * Eigen::Vector3d(10, 7, 3));
      REQUIRE(tiling.packing.size() == 10 * 7 * 3);
      REQUIRE(tiling.repeats == std::array<std::int64_t, 3>{{4, 3, 1}});
      REQUIRE(!tiling.packing.periodic_cell);
    }
}

TEST_CASE("kept spheres are those of the repeated packing that lie fully inside", "[dem][packing]")
{
  dem::Packing cell;
  cell.centre        = {{0.2, 0.5, 0.5}, {1.9, -0.5, 7.25}}; // the second lies outside: it stands for (0.9, 0.5, 0.25)
  cell.radius        = {0.2, 0.1};
  cell.periodic_cell = Eigen::Vector3d(1, 1, 1);
  const auto tiling  = dem::tile_and_crop(cell, {2.05, 1.0, 1.0});
  // Along x: first at 0.2 (touches the face), 1.2; 2.2 is out. Second at 0.9, 1.9 (reaches 2.0); 2.9 is out.
  REQUIRE(tiling.packing.size() == 4);
  const double x[] = {0.2, 0.9, 1.2, 1.9}, z[] = {0.5, 0.25, 0.5, 0.25}, r[] = {0.2, 0.1, 0.2, 0.1};
  for (int i = 0; i < 4; ++i)
    {
      REQUIRE(tiling.packing.centre[i].isApprox(Eigen::Vector3d(x[i], 0.5, z[i]), 1e-14));
      REQUIRE(tiling.packing.radius[i] == r[i]);
    }
}

TEST_CASE("a free packing is cropped, not repeated", "[dem][packing]")
{
  dem::Packing packing;
  packing.centre    = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {-0.5, 0.5, 0.5}, {0.5, 0.5, 0.95}};
  packing.radius    = {0.1, 0.1, 0.1, 0.1};
  const auto tiling = dem::tile_and_crop(packing, {1, 1, 1});
  REQUIRE(tiling.packing.size() == 1);
  REQUIRE(tiling.packing.centre[0] == packing.centre[0]);
  REQUIRE(tiling.note.empty());
}

TEST_CASE("discs are tiled in their plane", "[dem][packing]")
{
  const double       far  = std::numeric_limits<double>::infinity();
  const dem::Packing cell = dem::make_lattice(dem::Lattice::square, 0.5, {{2, 2, 1}});
  REQUIRE(dem::tile_and_crop(cell, {5, 3, far}).packing.size() == 15);
}

TEST_CASE("a period shorter than nine diameters is reported, where it repeats", "[dem][packing]")
{
  const auto note = [](const int cells, const double box) {
    return dem::tile_and_crop(dem::make_lattice(dem::Lattice::simple_cubic, 0.5, {{cells, cells, cells}}),
                              Eigen::Vector3d::Constant(box))
      .note;
  };
  REQUIRE_THAT(note(8, 10), Contains("8 diameters"));
  REQUIRE(note(9, 10).empty());
  REQUIRE(note(8, 8).empty());
}

TEST_CASE("a box that cannot be filled is refused", "[dem][packing]")
{
  const dem::Packing cell = dem::make_lattice(dem::Lattice::simple_cubic, 1e-3, {{5, 5, 5}});
  const double       far  = std::numeric_limits<double>::infinity();
  REQUIRE_THROWS_WITH(dem::tile_and_crop(cell, {0.05, 0.0, 0.05}), Contains("above zero"));
  REQUIRE_THROWS_WITH(dem::tile_and_crop(cell, {0.05, std::nan(""), 0.05}), Contains("above zero"));
  REQUIRE_THROWS_WITH(dem::tile_and_crop(cell, {1e-3, 1e-3, 1e-3}), Contains("no sphere lies fully inside"));
  REQUIRE_THROWS_WITH(dem::tile_and_crop(cell, {50, 50, 50}), Contains("metres"));
  REQUIRE_THROWS_WITH(dem::tile_and_crop(cell, {0.05, 0.05, far}), Contains("2^31"));
  REQUIRE_THROWS_AS(dem::tile_and_crop({}, {1, 1, 1}), base::InputError);
}
