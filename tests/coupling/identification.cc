#include "base/errors.h"
#include "coupling/sequential/identify.h"
#include "fem/points/material_kind_of.h"
#include "fem/references/concrete_points.h"

#include <catch2/catch.hpp>

using namespace fem::references;

using namespace coupling;

namespace
{
  fem::MaterialConstantsOf<fem::DamagePlasticConcrete> solid_concrete()
  {
    auto p              = material_m2();
    p.largest_increment = 2e-4;
    return fem::MaterialConstantsOf<fem::DamagePlasticConcrete>(p);
  }
} // namespace

TEST_CASE("identification finds the law that made the observations", "[coupling]")
{
  // Observations made by a known law: tensors of growing damage, and the continuum's own damage at the stress they stand for.
  const ContinuumReference reference(solid_concrete(), 2.0, true, 3.5e-5, 0.1);
  MappingLaw               truth;
  truth.weights  = {{0.7, 0.0, 0.3}};
  truth.factor   = 1.4;
  truth.exponent = 3.2;
  std::vector<ParticleObservation> observations;
  for (const double relative : {0.95, 0.85, 0.7, 0.55, 0.4, 0.3, 0.2})
    {
      // Omega = m diag(1, 0.8, q) with q from state to state, m such that the law gives the damage wanted.
      const double q       = -0.4 + 0.5 * relative * relative;
      const double measure = std::pow(reference.damage_at(relative), 1 / truth.exponent) / truth.factor;
      const double m       = measure / (0.7 + 0.3 * q);
      observations.push_back({Eigen::Vector3d(m, 0.8 * std::abs(m), m * q).asDiagonal(), relative, true});
    }
  const Identification found = identify(observations, reference, {});
  CHECK(found.damaged == 7);
  CHECK(found.damage_error < 1e-8);
  CHECK(found.law.factor == Approx(1.4).epsilon(1e-5));
  CHECK(found.law.exponent == Approx(3.2).epsilon(1e-5));
  CHECK(found.law.weights[0] == Approx(0.7).epsilon(1e-5));
}

TEST_CASE("the continuum's reference knows its peak, its hardening and its damage", "[coupling]")
{
  const ContinuumReference reference(solid_concrete(), 2.0, true, 3.5e-5, 0.2);
  CHECK(reference.peak() == Approx(40e6).epsilon(1e-4)); // M2: f_c
  // State published at strain -2.45e-3: 27.839 MPa, omega = 0.30404 (doc/theory/damage-plastic-concrete.md, 6, M2).
  CHECK(reference.damage_at(27.839 / 40) == Approx(0.30404).epsilon(2e-3));
  CHECK(reference.hardening_at(0.3) > 0);
  CHECK(reference.hardening_at(0.3) < reference.hardening_at(0.9));
  CHECK(reference.hardening_at(1.0) <= 1);
}

TEST_CASE("too few states after the peak are refused", "[coupling]")
{
  const ContinuumReference reference(solid_concrete(), 2.0, true, 3.5e-5, 0.5);
  CHECK_THROWS_WITH(
    identify(std::vector<ParticleObservation>(3, {Eigen::Matrix3d::Identity(), 0.5, true}), reference, {}),
    Catch::Contains("3 states after the peak"));
}
