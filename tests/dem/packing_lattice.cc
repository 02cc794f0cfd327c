#include "base/errors.h"
#include "dem/neighbours/cell_list.h"
#include "dem/packing/lattice.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  struct Known
  {
    dem::Lattice       lattice;
    std::array<int, 3> cells;
    std::size_t        particles;
    int                neighbours;
    double             fraction; ///< of the volume, of the plane for discs
  };

  const Known all[] = {{dem::Lattice::simple_cubic, {{3, 2, 4}}, 24, 6, M_PI / 6},
                       {dem::Lattice::body_centred_cubic, {{2, 3, 2}}, 24, 8, M_PI *std::sqrt(3.0) / 8},
                       {dem::Lattice::face_centred_cubic, {{2, 2, 1}}, 16, 12, M_PI / (3 * std::sqrt(2.0))},
                       {dem::Lattice::square, {{4, 3, 1}}, 12, 4, M_PI / 4},
                       {dem::Lattice::hexagonal, {{3, 2, 1}}, 12, 6, M_PI / (2 * std::sqrt(3.0))}};
} // namespace

TEST_CASE("lattices have their packing fraction and number of touching neighbours", "[dem][packing]")
{
  const double radius = 0.7;
  for (const Known &known : all)
    {
      const dem::Packing packing = dem::make_lattice(known.lattice, radius, known.cells);
      REQUIRE(packing.size() == known.particles);
      const Eigen::Vector3d cell     = *packing.periodic_cell;
      const bool            planar   = std::isinf(cell[2]);
      const double          fraction = planar ? known.particles * M_PI * radius * radius / (cell[0] * cell[1]) :
                                                dem::solid_volume(packing) / cell.prod();
      REQUIRE(fraction == Approx(known.fraction).epsilon(1e-13)); // rounding

      // Touching: within a millionth of the diameter; the next shell of each lattice is 15 % or more farther.
      REQUIRE(dem::find_pairs(packing.centre, packing.radius, 1 - 1e-6, 0, packing.periodic_cell).empty());
      const auto touching = dem::find_pairs(packing.centre, packing.radius, 1 + 1e-6, 0, packing.periodic_cell);
      REQUIRE(2 * touching.size() == known.neighbours * known.particles);
      REQUIRE_NOTHROW(dem::check_packing(packing, "lattice"));
    }
}

TEST_CASE("a lattice without sense is refused", "[dem][packing]")
{
  using Catch::Contains;
  REQUIRE_THROWS_WITH(dem::make_lattice(dem::Lattice::simple_cubic, 0.0, {{1, 1, 1}}), Contains("radius"));
  // A number as it was typed, neither in 300 digits nor, of a millimetre's size and below, as zero.
  REQUIRE_THROWS_WITH(dem::make_lattice(dem::Lattice::simple_cubic, -1e300, {{1, 1, 1}}),
                      Contains("radius = -1e+300:"));
  REQUIRE_THROWS_WITH(dem::make_lattice(dem::Lattice::simple_cubic, -1e-9, {{1, 1, 1}}), Contains("radius = -1e-09:"));
  REQUIRE_THROWS_WITH(dem::make_lattice(dem::Lattice::simple_cubic, 1.0, {{1, 0, 1}}), Contains("1 x 0 x 1"));
  REQUIRE_THROWS_AS(dem::make_lattice(dem::Lattice::square, 1.0, {{1, 1, 2}}), base::InputError);
}
