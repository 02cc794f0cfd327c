#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/materials/mixed_control.h"

#include <catch2/catch.hpp>

using base::Stiffness;
using base::Voigt;

namespace
{
  fem::IsotropicElastic steel()
  {
    fem::IsotropicElasticParameters p;
    p.young_modulus = 200e9;
    p.poisson_ratio = 0.3;
    return fem::IsotropicElastic(p);
  }
}

TEST_CASE("isotropic elasticity: uniaxial stress gives E, lateral strain nu, shear G", "[fem]")
{
  const auto       law = steel();
  fem::MixedTarget pull;
  pull.stress_given.fill(true);
  pull.value << 1e6, 0, 0, 2e5, -3e5, 4e5;
  const Voigt  strain = fem::solve_mixed(law, pull, {}, {}, 1e6).strain;
  const double g      = 200e9 / 2.6;
  const Voigt  hooke  = (Voigt() << 5e-6, -1.5e-6, -1.5e-6, 2e5 / g, -3e5 / g, 4e5 / g).finished();
  CHECK((strain - hooke).norm() <= 1e-14 * 5e-6 * 1e3); // rounding of a 6 x 6 solve
}

TEST_CASE("anisotropic elasticity takes an isotropic matrix and a full one", "[fem]")
{
  const fem::AnisotropicElastic same(steel().elastic_stiffness());
  const Voigt                   e = (Voigt() << 1, -2, 3, 4, -5, 6).finished() * 1e-4;
  CHECK(same.evaluate(e, {}, {}).stress == steel().evaluate(e, {}, {}).stress);

  Stiffness full = Stiffness::Identity() * 10e9;
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      full(i, j) = full(j, i) = 1e9 / (1 + i + j);
  const fem::AnisotropicElastic law(full);
  double                        stress_1 = 0;
  for (int j = 0; j < 6; ++j)
    stress_1 += full(1, j) * e[j];
  CHECK(law.evaluate(e, {}, {}).stress[1] == Approx(stress_1).epsilon(1e-14));

  fem::AnisotropicElasticParameters p;
  unsigned int                      next = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      p.upper[next++] = full(i, j);
  CHECK(fem::AnisotropicElastic(p).elastic_stiffness() == full);
}

TEST_CASE("elastic materials refuse what is not elastic", "[fem]")
{
  Stiffness skew = steel().elastic_stiffness();
  skew(0, 3) += 1e9;
  CHECK_THROWS_WITH(fem::AnisotropicElastic(skew), Catch::Contains("must be symmetric"));
  Stiffness indefinite = steel().elastic_stiffness();
  indefinite(4, 4)     = -1;
  CHECK_THROWS_WITH(fem::AnisotropicElastic(indefinite), Catch::Contains("lowest eigenvalue"));
  CHECK_THROWS(fem::AnisotropicElastic(fem::AnisotropicElasticParameters{}));

  fem::IsotropicElasticParameters p;
  CHECK_THROWS_WITH(fem::IsotropicElastic(p), Catch::Contains("Young modulus"));
  p.young_modulus = 1e9;
  p.poisson_ratio = 0.5;
  CHECK_THROWS_WITH(fem::IsotropicElastic(p), Catch::Contains("Poisson ratio = 0.5"));
}
