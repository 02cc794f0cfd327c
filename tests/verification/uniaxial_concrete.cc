// The uniaxial scene of the mesoscale specification 9.3 against the values published for it, and its similarity rules 3.9.
#include "dem/loading/uniaxial.h"
#include "dem/packing/compaction.h"
#include "dem/packing/tiling.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  constexpr double radius = 1e-3;

  dem::CpmParameters concrete()
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = 30;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  dem::Packing cube(const double edge, const std::uint64_t seed)
  {
    dem::CompactionParameters parameters; // its defaults make the packing fraction 0.55 of the published specimens
    parameters.radius = radius;
    parameters.seed   = seed;
    return dem::tile_and_crop(dem::compact(parameters).packing, Eigen::Vector3d::Constant(edge)).packing;
  }

  struct Outcome
  {
    dem::UniaxialFigures figures;
    double               balance_error;
  };

  Outcome load(const dem::Packing &packing, const dem::CpmParameters &material, const double strain_rate)
  {
    dem::SpecimenParameters specimen_parameters;
    specimen_parameters.density           = 4800;
    specimen_parameters.interaction_ratio = 1.5;
    specimen_parameters.damping           = 0.3;
    dem::Specimen specimen(packing, specimen_parameters, material);

    dem::UniaxialParameters loading;
    loading.strain_rate    = strain_rate;
    loading.grip_thickness = 2.2 * radius;
    loading.stop_fraction  = strain_rate > 0 ? 0.2 : 0.7;
    loading.stop_strain    = 5e-3;
    dem::UniaxialTest test(specimen, loading);
    double            worst = 0;
    while (!test.finished())
      {
        test.advance(20);
        worst = std::max(worst, specimen.energy().balance_error());
      }
    return {test.figures(), worst};
  }
} // namespace

TEST_CASE("50 mm cubes of three seeds have the published modulus and strengths in tension and compression",
          "[verification][slow]")
{
  for (const std::uint64_t seed : {1, 2, 3})
    {
      CAPTURE(seed);
      const dem::Packing packing     = cube(0.05, seed);
      const Outcome      tension     = load(packing, concrete(), 0.4);
      const Outcome      compression = load(packing, concrete(), -3.0);
      const double       ratio       = compression.figures.strength / tension.figures.strength;
      CAPTURE(packing.size(), tension.figures.young_modulus, tension.figures.strength, compression.figures.strength,
              ratio);
      // Stransky (2018), reference values of specification 9.3; the bands allow for another random packing and the exactly objective
      // shear update.
      CHECK(tension.figures.young_modulus == Approx(27e9).margin(3e9));
      CHECK(tension.figures.strength == Approx(3.47e6).margin(0.5e6));
      CHECK(compression.figures.strength == Approx(32.5e6).margin(5e6));
      CHECK(ratio > 8);
      CHECK(ratio < 11);
      CHECK(tension.balance_error < 1e-3);
      CHECK(compression.balance_error < 1e-3);
    }
}

TEST_CASE("doubling modulus and cohesion at constant limit strain doubles modulus and strengths",
          "[verification][slow]")
{
  const dem::Packing packing = cube(0.025, 1);
  dem::CpmParameters doubled = concrete();
  doubled.normal_modulus *= 2;
  doubled.cohesion *= 2;
  for (const double rate : {0.4, -3.0})
    {
      CAPTURE(rate);
      const dem::UniaxialFigures once  = load(packing, concrete(), rate).figures,
                                 twice = load(packing, doubled, rate).figures;
      // 3 %: specification 9.3; inertia does not scale with the modulus at a given rate.
      CHECK(twice.young_modulus == Approx(2 * once.young_modulus).epsilon(0.03));
      CHECK(twice.strength == Approx(2 * once.strength).epsilon(0.03));
      CHECK(twice.strain_at_peak == Approx(once.strain_at_peak).epsilon(0.1)); // a flat peak: its place is less sharp
    }
}
