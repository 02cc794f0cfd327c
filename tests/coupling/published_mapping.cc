#include "coupling/references/published_transfers.h"
#include "coupling/references/references.h"
#include "coupling/sequential/mapping_law.h"
#include "tests/compare.h"

#include <cmath>

using coupling::references::published_cases;
using coupling::references::PublishedCase;

namespace
{
  Eigen::Matrix3d diagonal(const std::array<double, 3> &values)
  {
    return Eigen::Vector3d(values[0], values[1], values[2]).asDiagonal();
  }
} // namespace

TEST_CASE("published tensors and those with the right factor are each other's image", "[coupling]")
{
  compare(coupling::all_references(), "transfer: published damage tensors");
}

TEST_CASE("published states map to the published damage and hardening, by the default law and by the published one",
          "[coupling]")
{
  compare(coupling::all_references(), "transfer: mapped damage and hardening");
  const coupling::MappingLaw law, legacy = coupling::mapping_laws().at(1).law;
  for (const PublishedCase &c : published_cases())
    {
      CAPTURE(c.name);
      const auto mapped = coupling::map_damage(diagonal(c.corrected), law);
      const auto same   = coupling::map_damage(diagonal(c.corrected), legacy);
      CHECK(same.raw == Approx(mapped.raw).epsilon(1e-9)); // two forms of one computation
    }
}

TEST_CASE("continuations of the published states follow the published stresses", "[coupling]")
{
  compare(coupling::all_references(), "transfer: continued compression");
}

TEST_CASE("the refitted law follows the loss of strength of the published states after the peak", "[coupling]")
{
  // Peak 39.476 MPa; published states past it (doc/theory/sequential-transfer.md, 3: root mean square 0.008 over the whole branch).
  const coupling::MappingLaw law = coupling::mapping_laws().at(2).law;
  for (const PublishedCase &c : published_cases())
    if (std::string(c.name) == "005")
      CHECK(coupling::map_damage(diagonal(c.corrected), law).raw == Approx(1 + c.stress[2] / 39.476e6).margin(0.02));
}

TEST_CASE("a mapping law with constants out of range is refused by name", "[coupling]")
{
  using Catch::Contains;
  coupling::MappingLaw law;
  REQUIRE_NOTHROW(law.validate());
  law.hardening_slope = 2000;
  CHECK_THROWS_WITH(law.validate(), Contains("hardening start + slope x switch damage = 1.3") && Contains("below 1"));
  law          = {};
  law.exponent = 0;
  CHECK_THROWS_WITH(law.validate(), Contains("exponent = 0"));
  law               = {};
  law.switch_damage = 1;
  CHECK_THROWS_WITH(law.validate(), Contains("switch damage = 1"));
}
