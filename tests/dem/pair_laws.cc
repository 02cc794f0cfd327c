// Constants of links between particles of different materials, doc/theory/links.md, 3.
#include "base/errors.h"
#include "dem/laws/cpm.h"
#include "dem/packing/tiling.h"
#include "two_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using Catch::Matchers::Contains;

namespace
{
  dem::CpmMaterial soft()
  {
    dem::CpmParameters p;
    p.normal_modulus          = 20e9;
    p.shear_ratio             = 0.2;
    p.limit_elastic_strain    = 1e-4;
    p.relative_ductility      = 30;
    p.cohesion                = 3e6;
    p.friction_coefficient    = 0; // 0 degrees
    p.shear_contribution      = 0;
    p.residual_strength_limit = 1e-4;
    return {"soft", p, 0};
  }

  dem::CpmMaterial hard()
  {
    dem::CpmParameters p;
    p.normal_modulus          = 60e9;
    p.shear_ratio             = 0.4;
    p.limit_elastic_strain    = 3e-4;
    p.relative_ductility      = 10;
    p.cohesion                = 9e6;
    p.friction_coefficient    = 1; // 45 degrees
    p.shear_contribution      = 0.5;
    p.residual_strength_limit = 3e-4;
    return {"hard", p, 0};
  }
} // namespace

TEST_CASE("link between two materials has the means of their constants, and of the angle of friction", "[dem]")
{
  const dem::CpmParameters between = dem::mean_of(soft(), hard());
  CHECK(between.normal_modulus == Approx(40e9).epsilon(1e-15));
  CHECK(between.shear_ratio == Approx(0.3).epsilon(1e-15));
  CHECK(between.limit_elastic_strain == Approx(2e-4).epsilon(1e-15));
  CHECK(between.relative_ductility == Approx(20).epsilon(1e-15));
  CHECK(between.cohesion == Approx(6e6).epsilon(1e-15));
  CHECK(between.shear_contribution == Approx(0.25).epsilon(1e-15));
  CHECK(between.residual_strength_limit == Approx(2e-4).epsilon(1e-15));
  CHECK(between.friction_coefficient ==
        Approx(std::sqrt(2.0) - 1).epsilon(1e-14)); // tan 22.5 degrees; mean of tan: 0.5

  const std::vector<dem::CpmParameters> pairs = dem::CpmMaterials({soft(), hard()}).pairs();
  const dem::CpmConstants               mean(pairs[dem::material_pair(1, 0)]);
  CHECK(mean.G == Approx(0.3 * 40e9).epsilon(1e-15));        // not the mean of 4e9 and 24e9
  CHECK(mean.softening == Approx(20 * 2e-4).epsilon(1e-15)); // not the mean of 3e-3 and 3e-3
  CHECK(pairs[dem::material_pair(0, 0)].normal_modulus == 20e9);
  CHECK(pairs[dem::material_pair(1, 1)].normal_modulus == 60e9);
  CHECK(dem::mean_of(hard(), soft()).friction_coefficient == between.friction_coefficient);
}

TEST_CASE("mean of a material with itself is the material, to the last bit", "[dem]")
{
  for (const dem::CpmMaterial &m : {soft(), hard(), dem::CpmMaterial{"", cluster::concrete(), 0}})
    {
      const dem::CpmParameters same = dem::mean_of(m, m);
      CHECK(same.normal_modulus == m.parameters.normal_modulus);
      CHECK(same.shear_ratio == m.parameters.shear_ratio);
      CHECK(same.limit_elastic_strain == m.parameters.limit_elastic_strain);
      CHECK(same.relative_ductility == m.parameters.relative_ductility);
      CHECK(same.cohesion == m.parameters.cohesion);
      CHECK(same.friction_coefficient == m.parameters.friction_coefficient);
      CHECK(same.residual_strength_limit == m.parameters.residual_strength_limit);
    }
}

TEST_CASE("pairs of materials are numbered without gaps, whichever comes first", "[dem]")
{
  const std::int32_t     materials = 6;
  std::set<std::int32_t> seen;
  for (std::int32_t a = 0; a < materials; ++a)
    for (std::int32_t b = 0; b <= a; ++b)
      {
        CHECK(dem::material_pair(a, b) == dem::material_pair(b, a));
        seen.insert(dem::material_pair(a, b));
      }
  CHECK(seen.size() == materials * (materials + 1) / 2);
  CHECK(*seen.begin() == 0);
  CHECK(*seen.rbegin() == materials * (materials + 1) / 2 - 1);
}

TEST_CASE("materials whose damage laws differ are refused, both named", "[dem]")
{
  dem::CpmMaterial linear      = hard();
  linear.parameters.damage_law = dem::DamageLaw::linear;
  CHECK_THROWS_WITH(dem::LinkMaterials(dem::CpmMaterials({soft(), linear})).bonds(dem::Physics()),
                    Contains("Damage law") && Contains("soft has the exponential one") &&
                      Contains("hard the linear one"));
  CHECK_THROWS_AS(dem::mean_of(soft(), linear), base::InputError);
}

TEST_CASE("a packing's materials are checked, and stay with their particles when it is tiled and cropped", "[dem]")
{
  dem::Packing packing  = cluster::cubic_lattice(3, 2, 2, 1e-3);
  packing.periodic_cell = Eigen::Vector3d(6e-3, 4e-3, 4e-3);
  for (const auto &x : packing.centre)
    packing.material.push_back(x.x() > 3e-3 ? 1 : 0);
  packing.material_names = {"mortar", "aggregate"};
  for (auto &x : packing.centre)
    x += Eigen::Vector3d::Constant(1e-3);
  CHECK_NOTHROW(dem::check_packing(packing, "packing"));

  const dem::Packing filled = dem::tile_and_crop(packing, {18e-3, 4e-3, 4e-3}).packing;
  REQUIRE(filled.size() == 9 * 4);
  REQUIRE(filled.material.size() == filled.size());
  CHECK(filled.material_names == packing.material_names);
  for (std::size_t i = 0; i < filled.size(); ++i)
    CHECK(filled.material[i] == (std::fmod(filled.centre[i].x(), 6e-3) > 4e-3 ? 1 : 0));

  const auto refused = [&](const auto &change) {
    dem::Packing changed = packing;
    change(changed);
    return [changed] { dem::check_packing(changed, "p.txt"); };
  };
  CHECK_THROWS_WITH(refused([](auto &p) { p.material.pop_back(); })(),
                    Contains("p.txt: 12 particles but the materials of 11"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.material[4] = -1; })(), Contains("particle 5: material = -1"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.material[4] = 2; })(),
                    Contains("particle 5: material = 2: there are names"));
  CHECK_THROWS_WITH(refused([](auto &p) { p.material_names[1] = "two words"; })(), Contains("\"two words\""));
  CHECK_THROWS_WITH(refused([](auto &p) { p.material_names[1] = "mortar"; })(), Contains("stands for two"));
  CHECK_THROWS_WITH(dem::Specimen(packing, cluster::bonded(1.1), dem::CpmMaterials({{"only", cluster::concrete(), 0}})),
                    Contains("particle 3: material = 1: 1 given"));
}
