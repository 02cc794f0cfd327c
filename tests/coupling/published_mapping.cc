#include "coupling/sequential/mapping_law.h"
#include "dem/measures/damage_tensor.h"
#include "fem/materials/mixed_control.h"
#include "tests/coupling/published_cases.h"
#include "tests/fem/concrete_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using coupling_tests::published_cases;
using coupling_tests::PublishedCase;

namespace
{
  Eigen::Matrix3d diagonal(const std::array<double, 3> &values)
  {
    return Eigen::Vector3d(values[0], values[1], values[2]).asDiagonal();
  }

  base::Voigt voigt_of(const std::array<double, 6> &values) { return Eigen::Map<const base::Voigt>(values.data()); }

  /// Tensors are printed with six decimals; the law's exponent magnifies what is lost of a small measure.
  double printed_digits(const PublishedCase &c)
  {
    const double measure = 0.58 * c.corrected[0] - 0.10 * c.corrected[1] + 0.02 * c.corrected[2];
    return 4.7 * 0.5e-6 / measure + 5e-4;
  }
} // namespace

TEST_CASE("published tensors and those with the right factor are each other's image", "[coupling]")
{
  for (const PublishedCase &c : published_cases())
    {
      CAPTURE(c.name);
      const Eigen::Matrix3d back  = dem::with_published_factor(diagonal(c.corrected)),
                            forth = dem::from_published_factor(diagonal(c.published));
      for (int i = 0; i < 3; ++i) // six decimals are printed
        {
          CHECK(back(i, i) == Approx(c.published[static_cast<std::size_t>(i)]).margin(2e-6));
          CHECK(forth(i, i) == Approx(c.corrected[static_cast<std::size_t>(i)]).margin(2e-6));
        }
    }
}

TEST_CASE("published states map to the published damage and hardening, by the default law and by the published one",
          "[coupling]")
{
  const coupling::MappingLaw       law, legacy = coupling::mapping_laws().at(1).law;
  const fem::DamagePlasticConcrete concrete(material_m2());
  for (const PublishedCase &c : published_cases())
    {
      CAPTURE(c.name);
      const auto mapped = coupling::map_damage(diagonal(c.corrected), law);
      CHECK(mapped.raw == Approx(c.raw).epsilon(printed_digits(c)));
      CHECK(mapped.damage == Approx(c.damage).epsilon(5e-4));
      const auto same = coupling::map_damage(diagonal(c.corrected), legacy);
      CHECK(same.raw == Approx(mapped.raw).epsilon(1e-9)); // two forms of one computation
      fem::InitialPointState given;
      given.stress     = voigt_of(c.stress);
      given.damage     = mapped.damage;
      given.hardening  = mapped.hardening;
      const auto state = concrete.initial_state(given, {});
      CHECK(state.kappa_d == Approx(c.kappa_d).epsilon(5e-4));
      CHECK(state.kappa_p == Approx(c.kappa_p).epsilon(5e-4));
    }
}

TEST_CASE("continuations of the published states follow the published stresses", "[coupling]")
{
  const coupling::MappingLaw       law;
  const fem::DamagePlasticConcrete concrete(material_m2());
  for (const PublishedCase &c : published_cases())
    {
      const auto             mapped = coupling::map_damage(diagonal(c.corrected), law);
      fem::InitialPointState given;
      given.stress      = voigt_of(c.stress);
      given.damage      = mapped.damage;
      given.hardening   = mapped.hardening;
      auto        state = concrete.initial_state(given, {});
      std::size_t next  = 0;
      for (int step = 0; next < c.after.size(); ++step)
        {
          // One tetrahedron, pushed along z: sides free, shear strains held at zero.
          fem::MixedTarget target;
          target.stress_given = {{true, true, false, false, false, false}};
          target.value[2]     = -3.5e-5 * step;
          state = fem::solve_mixed(concrete, target, state, {}, 1e6, fem::Increments::whole).response.trial;
          if (std::fabs(target.value[2] - c.after[next].strain) > 1e-9)
            continue;
          CAPTURE(c.name, target.value[2]);
          CHECK(state.stress[2] == Approx(1e6 * c.after[next].stress).epsilon(5e-4));
          ++next;
        }
    }
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
