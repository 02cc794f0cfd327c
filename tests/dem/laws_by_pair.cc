// Pairs of materials that obey laws of different kinds: doc/theory/link-laws.md, 4.
#include "dem/model/laws_by_pair.h"

#include "base/errors.h"
#include "closed_system.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/cpm.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "dem/statics/quasi_static_path.h"
#include "same_bits.h"
#include "two_materials.h"
#include "weak_bonds.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using Catch::Matchers::Contains;
using Eigen::Vector3d;
using namespace weak_bonds;

namespace
{
  const double r = 1e-3;

  /** Parallel bonds in mortar, contact bonds at the grains, flat joints in these. */
  dem::LinkMaterials three_laws()
  {
    return dem::LinkMaterials::by_pair({twice(parallel()), twice(point()), twice(flat())}, {0, 1, 2});
  }

  dem::Packing half_and_half(const std::size_t particles)
  {
    dem::Packing body = cluster::random_cluster(11, particles, 0.7 * r, r);
    for (const auto &x : body.centre)
      body.material.push_back(x.x() > 0 ? 1 : 0);
    return body;
  }

  dem::SpecimenParameters bonded()
  {
    dem::SpecimenParameters p = cluster::bonded(1.2);
    p.step_factor             = 0.1;
    return p;
  }

  dem::Specimen expanding(const dem::LinkMaterials &materials, const double rate)
  {
    const dem::Packing body = half_and_half(200);
    dem::Specimen      specimen(body, bonded(), materials);
    for (std::size_t i = 0; i < body.size(); ++i)
      specimen.set_velocity(i, rate * body.centre[i], Vector3d(30, -20, 10));
    return specimen;
  }
} // namespace

TEST_CASE("laws by pair: where both laws are the same it makes no difference which one a pair obeys", "[dem][laws]")
{
  auto weak                = parallel();
  weak.effective_modulus   = 4e9;
  weak.moment_contribution = 0.5;
  const dem::LinkMaterials one =
    dem::Materials<dem::ParallelBondParameters>({{"mortar", parallel(), 0}, {"grains", weak, 0}});
  const std::vector<std::int32_t> numbers = {0, 1, 0};
  dem::Specimen alone = expanding(one, 5), several = expanding(dem::LinkMaterials::by_pair({one, one}, numbers), 5);
  CHECK(several.time_step() == alone.time_step());
  CHECK(several.counts().links == alone.counts().links);
  alone.advance(600);
  several.advance(600);
  REQUIRE(alone.counts().broken > 5);
  CHECK(several.counts().broken == alone.counts().broken);
  const auto a = alone.particles(), b = several.particles();
  double     moved = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    {
      moved = std::max(moved, a.displacement[i].norm());
      CHECK((a.position[i] - b.position[i]).norm() <= 1e-12 * r);
      CHECK((a.angular_velocity[i] - b.angular_velocity[i]).norm() <= 1e-9 * a.angular_velocity[i].norm());
    }
  CHECK(moved > 1e-4 * r);
  CHECK(several.energy().released == Approx(alone.energy().released).epsilon(1e-10));
}

TEST_CASE("laws by pair: a body of three laws that breaks has the same bits for any threads and after a restart",
          "[dem][laws]")
{
  const auto materials = three_laws();
  check_same_bits([&] { return expanding(materials, 40); }, 300, 300, 11);
}

TEST_CASE("laws by pair: a body of three laws that breaks keeps momentum and energy", "[dem][laws]")
{
  dem::Specimen body  = expanding(three_laws(), 40);
  const auto    start = cluster::momenta(body);
  std::set<int> of_pairs;
  body.advance(600);
  const auto end = cluster::momenta(body);
  CHECK((end.linear - start.linear).norm() <= 1e-12 * end.linear_scale);
  CHECK((end.angular - start.angular).norm() <= 1e-10 * end.angular_scale);
  CHECK(body.energy().balance_error() < 1e-2);
  for (const dem::Break &each : body.breaks())
    of_pairs.insert(each.pair);
  CHECK(of_pairs == std::set<int>{0, 1, 2});
}

TEST_CASE("laws by pair: what one law remembers is kept apart from what another does, each under its own name",
          "[dem][laws]")
{
  const auto            law = three_laws().bonds(dem::Physics());
  std::set<std::string> names;
  for (const dem::LinkQuantity &quantity : law->columns())
    CHECK(names.insert(quantity.name).second);
  CHECK(names.size() == twice(parallel()).bonds(dem::Physics())->columns().size() +
                          twice(point()).bonds(dem::Physics())->columns().size() +
                          twice(flat()).bonds(dem::Physics())->columns().size());
  CHECK(std::string(law->name()) == "parallel-bond,contact-bond,flat-joint");
}

TEST_CASE("laws by pair: a row bears what the law of its weakest pair does, in equilibrium", "[dem][statics]")
{
  // mortar - mortar - grain: a parallel bond, stronger, and a contact bond
  dem::Packing packing = cluster::cubic_lattice(3, 1, 1, r);
  packing.material     = {0, 0, 1};
  dem::NetworkParameters linked;
  linked.interaction_ratio = 1.05;
  const auto    materials  = dem::LinkMaterials::by_pair({twice(parallel()), twice(point())}, {0, 1, 0});
  dem::GripPair grips;
  grips.axis = 0;
  dem::GripParameters ends;
  ends.thickness      = 0.1 * r;
  grips.layers        = dem::find_grip_layers({packing.centre, packing.radius}, 0, ends);
  const auto   loaded = dem::load_grips(dem::make_network(packing, linked, materials), grips);
  const double area = M_PI * r * r, length = 4 * r, section = loaded.volume / length,
               k1 = parallel().effective_modulus * area / (2 * r), k2 = point().effective_modulus * area / (2 * r);
  dem::QuasiStaticParameters p;
  p.strain_step = 1e-6;
  p.end_strain  = 1e-3;
  p.end_stress  = 0.3;
  dem::QuasiStaticPath path(loaded, materials, p);
  while (!path.finished())
    path.advance();
  double peak = 0;
  for (const auto &each : path.points())
    {
      const double force = each.stress[0] * section;
      peak               = std::max(peak, force);
      if (force > 0 && force < 0.99 * point().tensile_strength * area)
        CHECK(force == Approx(k1 * k2 / (k1 + k2) * each.strain[0] * length).epsilon(1e-9));
    }
  CHECK(peak == Approx(point().tensile_strength * area).epsilon(0.02));
}

TEST_CASE("laws by pair: pairs whose law carries no tension are not linked at the start, and push when they meet",
          "[dem][laws]")
{
  dem::LinearContactParameters loose;
  loose.effective_modulus   = 5e9;
  dem::Packing row          = cluster::cubic_lattice(3, 1, 1, r);
  row.material              = {0, 0, 1};
  dem::SpecimenParameters p = bonded();
  p.step_factor             = 0.02; // they meet within a step
  dem::Specimen specimen(row, p, dem::LinkMaterials::by_pair({twice(parallel()), twice(loose)}, {0, 1, 0}));
  CHECK(specimen.counts().links == 1);
  specimen.set_velocity(2, Vector3d(-1e-3, 0, 0), Vector3d::Zero());
  double deepest = 0;
  for (int i = 0; i < 2000; ++i)
    {
      specimen.advance(10);
      deepest = std::max(deepest, specimen.counts().deepest_overlap);
    }
  CHECK(deepest > 0);
  CHECK(specimen.particles().velocity[2].x() > 0);
  CHECK(specimen.energy().balance_error() < 1e-4);
}

TEST_CASE("laws by pair: contacts that are sought in different ways are refused, and one law for all is not",
          "[dem][laws]")
{
  const auto cohesive = twice(cluster::concrete());
  const auto mixed    = dem::LinkMaterials::by_pair({cohesive, twice(parallel())}, {0, 1, 0});
  CHECK_NOTHROW(mixed.bonds(dem::Physics()));
  CHECK_THROWS_WITH(mixed.contacts(dem::Physics()), Contains("CPM") && Contains("Contacts = linear"));

  dem::LinearContactParameters touch;
  touch.effective_modulus = 10e9;
  dem::Specimen body      = expanding(mixed.with_contacts(twice(touch)), 40);
  body.advance(600);
  CHECK(body.counts().broken > 10);
  CHECK(body.energy().balance_error() < 1e-2);
}
