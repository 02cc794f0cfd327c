// Networks and quasi-static paths of two materials.
#include "base/errors.h"
#include "dem/statics/quasi_static_path.h"
#include "two_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using Catch::Matchers::Contains;

namespace
{
  const double r = 1e-3, area = M_PI * r * r;

  dem::NetworkParameters linked()
  {
    dem::NetworkParameters p;
    p.interaction_ratio = 1.05;
    return p;
  }

  /** A row of touching spheres along x, gripped at its ends. */
  dem::LoadedNetwork row(const std::vector<std::int32_t> &material, const dem::CpmMaterials &materials)
  {
    dem::Packing packing = cluster::cubic_lattice(static_cast<int>(material.size()), 1, 1, r);
    packing.material     = material;
    dem::GripPair grips;
    grips.axis = 0;
    dem::GripParameters ends;
    ends.thickness = 0.1 * r;
    grips.layers   = dem::find_grip_layers({packing.centre, packing.radius}, 0, ends);
    return dem::load_grips(dem::make_network(packing, linked(), materials), grips);
  }

  std::vector<dem::QuasiStaticPoint> pulled(const dem::LoadedNetwork &loaded, const dem::CpmMaterials &materials)
  {
    dem::QuasiStaticParameters p;
    p.strain_step = 1e-5;
    p.end_strain  = 30e-4;
    p.growth_step = 0.02; // the work of the path is summed up by trapezoids
    p.end_stress  = 0.3;
    dem::QuasiStaticPath path(loaded, materials, p);
    while (!path.finished())
      path.advance();
    return path.points();
  }
} // namespace

TEST_CASE("two links of two materials are springs in series, and the weaker decides the strength", "[dem][statics]")
{
  const auto  materials = cluster::mortar_and_aggregate();
  const auto &mortar = materials.list[0].parameters, &aggregate = materials.list[1].parameters;
  // Aggregate - aggregate - mortar: a link of aggregate, and one of the means.
  const auto   loaded = row({1, 1, 0}, materials);
  const double E_mean = (mortar.normal_modulus + aggregate.normal_modulus) / 2,
               onset  = (mortar.limit_elastic_strain + aggregate.limit_elastic_strain) / 2,
               k1 = aggregate.normal_modulus * area / (2 * r), k2 = E_mean * area / (2 * r), length = 4 * r,
               section = loaded.volume / length;
  REQUIRE(E_mean * onset < aggregate.normal_modulus * aggregate.limit_elastic_strain);
  const auto path = pulled(loaded, materials);
  double     peak = 0;
  for (const auto &point : path)
    {
      const double force = point.stress[0] * section;
      peak               = std::max(peak, force);
      if (force > 0 && point.mean_damage == 0)
        CHECK(force == Approx(k1 * k2 / (k1 + k2) * point.strain[0] * length).epsilon(1e-9));
      if (point.mean_damage > 0)
        {
          // The weaker link is on its envelope, the other elastic; together they are as long as the row.
          const double of_weak = point.strain[0] * 2 - force / area / aggregate.normal_modulus;
          CHECK(force == Approx(area * E_mean * onset * std::exp(-(of_weak - onset) / (30 * onset))).epsilon(1e-6));
        }
      CHECK(point.balance_error() < 1e-3);
    }
  CHECK(peak == Approx(area * E_mean * onset).epsilon(0.01)); // a point at most one step past the onset
  CHECK(path.back().mean_damage > 0.3);
}

TEST_CASE("network of one material declared twice is that of one", "[dem][statics]")
{
  const dem::CpmMaterials once = cluster::concrete();
  const dem::CpmMaterials twice({{"a", cluster::concrete(), 0}, {"b", cluster::concrete(), 0}});
  const auto              one = row({0, 0, 0, 0}, once), two = row({0, 1, 1, 0}, twice);
  REQUIRE(one.network.links.size() == two.network.links.size());
  for (std::size_t l = 0; l < one.network.links.size(); ++l)
    CHECK(one.network.links[l].stiffness == two.network.links[l].stiffness);
  const auto a = pulled(one, once), b = pulled(two, twice);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK(a[i].stress == b[i].stress);
}

TEST_CASE("network refuses a material that is not given", "[dem][statics]")
{
  CHECK_THROWS_WITH(row({0, 2, 1}, cluster::mortar_and_aggregate()), Contains("particle 2: material = 2: 2 given"));
  CHECK_THROWS_AS(row({0, 2, 1}, cluster::mortar_and_aggregate()), base::InputError);
}
