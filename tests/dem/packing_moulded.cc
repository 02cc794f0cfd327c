#include "base/errors.h"
#include "dem/neighbours/cell_list.h"
#include "dem/packing/moulded_box.h"
#include "dem/packing/overlaps.h"
#include "dem/packing/tiling.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using Catch::Contains;

namespace
{
  dem::CompactionParameters spheres_of_friction(const double friction)
  {
    dem::CompactionParameters p;
    p.radius   = 1e-3;
    p.friction = friction;
    return p;
  }

  dem::Packing moulded(const dem::CompactionParameters &p, const Eigen::Vector3d &box)
  {
    return dem::moulded_box(p, box, [](const auto &requested) { return dem::compact(requested); });
  }

  double packing_fraction(const dem::Packing &packing, const Eigen::Vector3d &box)
  {
    return dem::solid_volume(packing) / box.prod();
  }

  /** Centres that lie against a face, a radius from it within a twentieth, per particle that a square layer has. */
  double layer(const dem::Packing &packing, const Eigen::Vector3d &box, const int direction, const bool far)
  {
    const double r       = packing.radius[0];
    const auto   against = std::count_if(packing.centre.begin(), packing.centre.end(), [&](const Eigen::Vector3d &x) {
      return std::abs((far ? box[direction] - x[direction] : x[direction]) - r) < 0.05 * r;
    });
    return static_cast<double>(against) * 4 * r * r * box[direction] / box.prod();
  }
} // namespace

TEST_CASE("one sphere in its mould is compacted to the closed form", "[dem][packing]")
{
  // Six plates press on it, each by k_n overlap: with s = overlap/r and edges 2 (1 - s), p 2r/k_n = s/(2 (1 - s)^2).
  auto p            = spheres_of_friction(0.5);
  p.moulded         = true;
  p.count           = 1;
  p.low_pressure    = 0.02;
  const auto   made = dem::compact(p);
  const double s    = 1 - made.edges.x() / (2 * p.radius);
  REQUIRE(s / (2 * (1 - s) * (1 - s)) == Approx(0.02).epsilon(0.01)); // the servo's tolerance
  REQUIRE(made.edges.y() == Approx(made.edges.x()).epsilon(1e-9));
  REQUIRE((made.packing.centre[0] - 0.5 * made.edges).norm() < 1e-3 * p.radius);
  REQUIRE_FALSE(made.packing.periodic_cell.has_value());
}

TEST_CASE("a layer of spheres lies against each face of a moulded box, and none beyond", "[dem][packing]")
{
  const auto            p = spheres_of_friction(1.0);
  const Eigen::Vector3d box(0.024, 0.016, 0.016);
  const dem::Packing    made = moulded(p, box);
  for (int d = 0; d < 3; ++d)
    for (const bool far : {false, true})
      CHECK(layer(made, box, d, far) > 0.5); // by chance, spread evenly, there would be 0.05
  for (const Eigen::Vector3d &x : made.centre)
    {
      CHECK(x.minCoeff() > 0.97 * p.radius); // plates give way, at the low pressure by 0.003 of a radius in the mean
      CHECK((box - x).minCoeff() > 0.97 * p.radius);
    }
  // Centres were spaced by some thousandths, and overlaps with them.
  CHECK_NOTHROW(dem::check_overlaps(made, "moulded box", 3));
  for (const dem::NeighbourPair &pair : dem::find_pairs(made.centre, made.radius, 1.0, 0.0, std::nullopt))
    CHECK((made.centre[pair.second] - made.centre[pair.first]).norm() > 0.96 * 2 * p.radius);
}

TEST_CASE("a moulded box holds what its inside would but for a fourteenth of a diameter at each face", "[dem][packing]")
{
  const auto            p = spheres_of_friction(1.0);
  const Eigen::Vector3d box(0.02, 0.02, 0.02); // ten diameters
  const double          inside = dem::expected_packing_fraction(p.friction);
  const double          room   = std::pow(1 - 2 * 0.07 / 10, 3);
  const dem::Packing    made   = moulded(p, box);
  CHECK(packing_fraction(made, box) == Approx(inside * room).epsilon(0.02)); // the scatter of seeds is 0.006

  const auto cut = dem::tile_and_crop(dem::compact(p).packing, box).packing;
  CHECK(packing_fraction(cut, box) < 0.75 * inside);
}

TEST_CASE("the same parameters give the same moulded box", "[dem][packing]")
{
  auto                  p = spheres_of_friction(0.5);
  const Eigen::Vector3d box(0.012, 0.01, 0.01);
  const auto            first = moulded(p, box);
  REQUIRE(first.centre == moulded(p, box).centre);
  p.seed = 2;
  REQUIRE(moulded(p, box).centre != first.centre);
}

TEST_CASE("a moulded box without room for a sphere, or for too many, is refused", "[dem][packing]")
{
  REQUIRE_THROWS_AS(moulded(spheres_of_friction(1), {0.02, 0.0019, 0.02}), base::InputError);
  REQUIRE_THROWS_WITH(moulded(spheres_of_friction(1), {0.02, 0.0019, 0.02}),
                      Contains("0.0019 m") && Contains("radius 0.001 m"));
  REQUIRE_THROWS_WITH(moulded(spheres_of_friction(1), {2, 2, 2}), Contains("1e8") && Contains("units"));
}
