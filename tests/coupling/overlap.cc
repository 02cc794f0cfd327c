// Shares of particles and solid in the layer where both are (doc/theory/volume-coupling.md, 1; static-handshake.md, 2).
#include "coupling/volume/overlap.h"

#include "coupling/volume/bond_shares.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  constexpr double width = 0.4;

  /** Between the planes x = 0 and x = width. */
  coupling::Overlap layer()
  {
    return {[](const Vector3d &x) { return x.x(); }, width};
  }

  /** Bonded particles along x, from a place to the last one. */
  coupling::BondedParticles row(const double first, const double spacing, const std::size_t number)
  {
    coupling::BondedParticles all;
    for (std::size_t i = 0; i < number; ++i)
      all.centre.push_back({first + spacing * static_cast<double>(i), 0, 0});
    for (std::size_t i = 0; i + 1 < number; ++i)
      all.bonds.push_back({i, i + 1, 0.5 * (all.centre[i] + all.centre[i + 1]), spacing});
    return all;
  }
} // namespace

TEST_CASE("overlap: across the layer the solid's share grows evenly from a thousandth, and the particles have the rest",
          "[coupling][volume]")
{
  const coupling::Overlap overlap = layer();
  for (const double x : {0.1, 0.2, 0.33})
    {
      CHECK(overlap.of_solid({x, 1, -2}) == Approx(x / width).epsilon(1e-14));
      CHECK(overlap.of_solid({x, 1, -2}) + overlap.of_particles({x, 1, -2}) == Approx(1).epsilon(1e-14));
    }
  CHECK(overlap.of_solid({1e-9, 0, 0}) == Approx(1e-3).epsilon(1e-12));
  CHECK(overlap.of_solid({width - 1e-9, 0, 0}) == Approx(1 - 1e-3).epsilon(1e-12));
  CHECK(overlap.of_particles({width - 1e-9, 0, 0}) == Approx(1e-3).epsilon(1e-12));
  CHECK(overlap.of_solid({width + 0.1, 0, 0}) == 1);
  CHECK(overlap.of_particles({-0.1, 0, 0}) == 1);
}

TEST_CASE("overlap: the part of a particle within it is that of a row, of which even stress leaves the difference of "
          "shares",
          "[coupling][volume]")
{
  // Within half a spacing of the layer's beginning a part of the particle lies before it: what is left of the difference of shares.
  constexpr double spacing = 0.08;
  const auto       part    = [](const double place, const std::size_t after) {
    const coupling::BondedParticles all = row(place - 3 * spacing, spacing, 4 + after);
    return coupling::parts_within(all, layer(), {3}).front();
  };
  CHECK(part(0, 9) == Approx(0.5).epsilon(1e-12));
  CHECK(part(spacing / 4, 9) == Approx(0.75).epsilon(1e-12));
  CHECK(part(spacing / 2, 9) == Approx(1).epsilon(1e-12));
  CHECK(part(0.2, 9) == Approx(1).epsilon(1e-12));
  CHECK(part(width - spacing / 2, 0) == Approx(1).epsilon(1e-12)); // the last of a row that ends with the layer
}
