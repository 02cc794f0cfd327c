#include "dem/peridynamics/lattice_constants.h"

#include <catch2/catch.hpp>

using namespace dem::peridynamics;

TEST_CASE("the elastic constants of the infinite square grid are the published ones", "[dem]")
{
  struct Row
  {
    BondModel model;
    Volumes   volumes;
    double    ratio, axis, poisson, shear, oblique;
    int       neighbours;
  };
  constexpr BondModel pm = BondModel::prototype, general = BondModel::general;
  constexpr Volumes   full = Volumes::full, partial = Volumes::partial;
  // peridynamics.md of the source documents, table 7.2.
  const Row rows[] = {{pm, full, 3, 1.0644, 0.3182, 1.0051, 1.0168, 28},
                      {pm, full, 3.015, 1.0486, 0.3182, 0.9902, 1.0017, 28},
                      {pm, full, 4, 0.9860, 0.3170, 0.9266, 0.9383, 48},
                      {pm, full, 5, 1.0038, 0.3623, 1.1164, 1.0932, 80},
                      {pm, full, 6, 0.9820, 0.3446, 1.0239, 1.0154, 112},
                      {pm, full, 12, 0.9649, 0.3316, 0.9586, 0.9599, 440},
                      {pm, partial, 3.015, 1.0434, 0.3165, 0.9786, 0.9913, 36},
                      {pm, partial, 4, 1.0188, 0.3294, 1.0037, 1.0067, 68},
                      {pm, partial, 6, 1.0100, 0.3306, 0.9996, 1.0017, 136},
                      {pm, partial, 12, 1.0021, 0.3335, 1.0026, 1.0025, 488},
                      {general, full, 3.015, 1.0721, 0.3178, 1.0108, 1.0228, 28},
                      {general, partial, 6, 1.0189, 0.3305, 1.0080, 1.0102, 136}};
  for (const Row &row : rows)
    {
      CAPTURE(row.ratio, row.neighbours);
      const LatticeConstants l = lattice_constants(Space::plane_stress, row.model, {row.ratio, row.volumes, false});
      CHECK(l.young_modulus == Approx(row.axis).margin(5.1e-5).epsilon(0));
      CHECK(l.poisson_ratio == Approx(row.poisson).margin(5.1e-5).epsilon(0));
      CHECK(l.shear_modulus == Approx(row.shear).margin(5.1e-5).epsilon(0));
      CHECK(l.young_modulus_oblique == Approx(row.oblique).margin(5.1e-5).epsilon(0));
      CHECK(l.neighbours == row.neighbours);
    }
  // The document cuts 1.02540 off after its fourth decimal.
  CHECK(lattice_constants(Space::plane_stress, pm, {3.015, full, false}).bulk ==
        Approx(1.0253).margin(1e-4).epsilon(0));
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
