// doc/theory/damage-plastic-concrete.md, 6: values published, or from an independent implementation.
#include "fem/references/concrete_points.h"
#include "fem/references/references.h"
#include "tests/compare.h"

using fem::all_references;

TEST_CASE("yield surface of concrete: derived constants and hardening law", "[fem]")
{
  compare(all_references(), "concrete: constants of the yield surface, hardening, ductility");
}

TEST_CASE("yield surface of concrete: spot values at a general stress", "[fem]")
{
  compare(all_references(), "concrete: yield surface and potential at a general stress");
}

TEST_CASE("damage law of concrete: values over size, and its inverse", "[fem]")
{
  compare(all_references(), "concrete: damage over opening");
  const fem::DamageLaw law(3e6 / 30e9, 3e-4);
  for (const double damage : {1e-6, 0.1, 0.5, 0.9, 0.999999})
    CHECK(1 - law.integrity(law.inverse(damage, 0.3), 0.3).value ==
          Approx(damage).epsilon(1e-9)); // 1 - omega loses digits near 1
}

TEST_CASE("concrete in uniaxial tension: reference values of stress, hardening and damage", "[fem]")
{
  compare(all_references(), "concrete in uniaxial tension");
}

TEST_CASE("concrete in uniaxial compression: reference values of stress, hardening and damage", "[fem]")
{
  compare(all_references(), "concrete in uniaxial compression");
}

TEST_CASE("concrete in oedometric and hydrostatic strain: reference values", "[fem]")
{
  compare(all_references(), "concrete in oedometric and hydrostatic strain");
}

TEST_CASE("concrete on a non-proportional path: reference values", "[fem]")
{
  compare(all_references(), "concrete on a non-proportional path");
}

TEST_CASE("concrete of the sequential mapping: published curve in uniaxial compression", "[fem]")
{
  compare(all_references(), "concrete of the sequential mapping in compression");
  fem::references::UniaxialPoint point(fem::references::material_m2());
  for (int n = 1; n <= 66; ++n)
    point.go_to(-3.5e-5 * n, 1);
  CHECK(point.state.damage > 0); // from the step after the peak on
}
