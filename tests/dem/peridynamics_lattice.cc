#include "dem/peridynamics/lattice_constants.h"
#include "dem/references/references.h"
#include "tests/compare.h"

using namespace dem::peridynamics;

TEST_CASE("the elastic constants of the infinite square grid are the published ones", "[dem]")
{
  compare(dem::all_references(), "peridynamics: elastic constants of the square grid");
}

TEST_CASE("large horizons with partial volumes have the continuum's constants in every kind of space", "[dem]")
{
  for (const Space space : {Space::rod, Space::plane_stress, Space::plane_strain, Space::space})
    for (const BondModel model : {BondModel::prototype, BondModel::general})
      {
        const LatticeConstants l = lattice_constants(space, model, {20.0, Volumes::partial, false});
        CHECK(l.young_modulus == Approx(1).margin(3e-3));
        CHECK(l.poisson_ratio == Approx(poisson_ratio(space)).margin(2e-3));
        CHECK(l.shear_modulus == Approx(1).margin(3e-3));
        CHECK(l.bulk == Approx(1).margin(3e-3));
      }
}

TEST_CASE("a calibrated grid has the constant that it was calibrated for", "[dem]")
{
  const LatticeConstants l =
    lattice_constants(Space::plane_stress, BondModel::prototype, {3.015, Volumes::full, false});
  CHECK(l.calibrated(Calibration::axis).young_modulus == Approx(1).epsilon(1e-14));
  CHECK(l.calibrated(Calibration::bulk).bulk == Approx(1).epsilon(1e-14));
  CHECK(l.calibrated(Calibration::axis).poisson_ratio == l.poisson_ratio);
  CHECK(l.calibrated(Calibration::axis).shear_modulus < 0.95); // what the axis gains, shear loses
}
