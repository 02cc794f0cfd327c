// Cells of several materials, and of bonds with moments.
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/compaction.h"
#include "tests/coupling/multiscale_fixture.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace multiscale;
using homogenisation_fixture::relative_difference;

namespace
{
  /** Every third particle is aggregate: stiffer, of other strengths. */
  dem::Packing mortar_and_aggregate()
  {
    dem::Packing packing = homogenisation_fixture::random_spheres(48, 3);
    for (std::size_t i = 0; i < packing.size(); ++i)
      packing.material.push_back(i % 3 == 0 ? 1 : 0);
    packing.material_names = {"mortar", "aggregate"};
    return packing;
  }

  dem::CpmMaterials two_materials()
  {
    dem::CpmParameters aggregate = concrete(3e-4);
    aggregate.normal_modulus     = 60e9;
    aggregate.cohesion           = 20e6;
    return dem::CpmMaterials({{"mortar", concrete(), 0}, {"aggregate", aggregate, 0}});
  }

  /** Of a law with bonds. @param modulus [Pa] */
  template <typename Parameters>
  Parameters bonds(const double modulus)
  {
    Parameters p;
    p.effective_modulus    = modulus;
    p.tensile_strength     = 3e6;
    p.cohesion             = 6e6;
    p.friction_coefficient = 0.5;
    return p;
  }

  dem::ContactBondParameters  contact_bonds() { return bonds<dem::ContactBondParameters>(25e9); }
  dem::ParallelBondParameters parallel_bonds() { return bonds<dem::ParallelBondParameters>(15e9); }
  dem::FlatJointParameters    flat_joints() { return bonds<dem::FlatJointParameters>(25e9); }

  /** Part of a strain up to which the particles, solved for, answer elastically. */
  double end_of_elasticity(const coupling::PreparedCell &cell, const base::Voigt &strain)
  {
    auto   solved = cell.promoted_at(base::Voigt::Zero(), cell.system_of_thread(0));
    double low = 0, high = 4;
    while (high - low > 1e-4)
      {
        const double      middle  = 0.5 * (low + high);
        const base::Voigt stress  = solved->respond(middle * strain, cell.system_of_thread(0), false).stress,
                          elastic = middle * (cell.stiffness() * strain);
        ((stress - elastic).norm() > 1e-8 * elastic.norm() ? high : low) = middle;
      }
    return low;
  }
} // namespace

TEST_CASE("mesoscale cells: their moduli are those of the homogenised packing", "[coupling][multiscale]")
{
  const auto             packing = mortar_and_aggregate();
  const auto             p       = parameters();
  coupling::PreparedCell cell(packing, two_materials(), p);
  const auto             D = dem::relaxed_stiffness(dem::make_network(packing, p.links, two_materials())).stiffness;
  CHECK(relative_difference(cell.stiffness(), D) < 1e-8);
  CHECK(cell.stiffness()(0, 0) > 1.2 * prepared()->stiffness()(0, 0)); // of mortar alone
}

TEST_CASE("mesoscale cells: particles take over by the strength of each pair of materials", "[coupling][multiscale]")
{
  const auto packing = mortar_and_aggregate();
  const auto law     = two_materials();
  const auto cell    = std::make_shared<coupling::PreparedCell>(packing, law, parameters(1e-10));
  for (const double sign : {1.0, -1.0})
    {
      base::Voigt at = mixed(sign * 1e-7);
      at /= cell->elastic_range()->nearest(at).exertion; // about to leave, to first order
      const double end = end_of_elasticity(*cell, at);
      CHECK(cell->elastic_range()->nearest(end * at).exertion == Approx(1).epsilon(1e-3));
      CHECK(end == Approx(1).epsilon(0.5));

      auto of = points({cell});
      of->allocate(1);
      requested(*of, 0.85 * end * at);
      of->commit();
      CHECK(of->promoted() == 0);
      const base::Voigt strain  = 0.95 * end * at;
      const base::Voigt elastic = cell->stiffness() * strain;
      CHECK((requested(*of, strain).stress - elastic).norm() < 1e-8 * elastic.norm());
      of->commit();
      CHECK(of->promoted() == 1);
    }
  // With aggregate throughout nothing has ended yet.
  coupling::PreparedCell strong(homogenisation_fixture::random_spheres(48, 3), law.list[1].parameters, parameters());
  const base::Voigt      pulled = mixed(1);
  CHECK(strong.elastic_range()->nearest(1e-6 * pulled).exertion <
        0.6 * cell->elastic_range()->nearest(1e-6 * pulled).exertion);
}

TEST_CASE("mesoscale cells: the tangent is the derivative while links of both materials damage",
          "[coupling][multiscale]")
{
  auto of =
    points({std::make_shared<coupling::PreparedCell>(mortar_and_aggregate(), two_materials(), parameters(1e-13))});
  of->allocate(1);
  requested(*of, mixed(2e-4));
  of->commit();
  const base::Voigt strain = mixed(2.2e-4);
  const auto        answer = requested(*of, strain);
  CHECK(of->dissipated(0, {}).damage > 0);
  base::Stiffness D;
  for (int c = 0; c < 6; ++c)
    D.col(c) = (requested(*of, strain + 1e-9 * base::Voigt::Unit(c), false).stress -
                requested(*of, strain - 1e-9 * base::Voigt::Unit(c), false).stress) /
               2e-9;
  CHECK(relative_difference(answer.tangent, D) < 1e-6);
}

TEST_CASE("cells of bonds: what bonds feel follows from the strain, until the first one breaks",
          "[coupling][multiscale]")
{
  for (const dem::LinkMaterials &law : {dem::LinkMaterials(contact_bonds()), dem::LinkMaterials(flat_joints())})
    {
      const auto  cell = prepared(law, parameters(1e-10), 3, 27);
      base::Voigt at   = mixed(1e-7);
      at /= cell->elastic_range()->nearest(at).exertion;
      const double end = end_of_elasticity(*cell, at);
      INFO("elasticity ends at " << end);
      CHECK(cell->elastic_range()->nearest(0.999 * end * at).exertion < 1);
      CHECK(cell->elastic_range()->nearest(1.001 * end * at).exertion >= 0.999);
      auto of = points({cell});
      of->allocate(1);
      requested(*of, 0.85 * end * at);
      of->commit();
      const base::Voigt strain  = 0.97 * end * at;
      const base::Voigt elastic = cell->stiffness() * strain;
      CHECK((requested(*of, strain).stress - elastic).norm() < 1e-8 * elastic.norm());
    }
}

TEST_CASE("cells of bonds: those stiffer one way than the other are promoted from the start, or refused by name",
          "[coupling][multiscale]")
{
  // Spheres that touch: with gaps between them there is no contact in parallel at first.
  dem::Packing packing = homogenisation_fixture::random_spheres(27, 3);
  packing.radius.assign(packing.size(), 1.6);
  auto p                    = parameters(1e-10);
  p.links.interaction_ratio = 1;
  CHECK_THROWS_WITH(coupling::PreparedCell(packing, parallel_bonds(), p),
                    Catch::Contains("parallel-bond") && Catch::Contains("from the start"));
  p.from_start    = true;
  const auto cell = std::make_shared<coupling::PreparedCell>(packing, parallel_bonds(), p);
  auto       of   = points({cell});
  of->allocate(1);
  const auto pulled = requested(*of, base::Voigt(1e-6 * base::Voigt::Unit(0))),
             pushed = requested(*of, base::Voigt(-1e-6 * base::Voigt::Unit(0)));
  CHECK(pulled.stress[0] > 0);
  CHECK(-pushed.stress[0] > 1.2 * pulled.stress[0]); // the contact in parallel pushes, and never pulls
}

TEST_CASE(
  "cells with damage and friction: what was pulled apart carries when it is closed again, and slides as a contact",
  "[coupling][multiscale]")
{
  const auto cell = prepared();
  auto       of   = points({cell});
  of->allocate(1);
  const auto drive = [&](const base::Voigt &from, const base::Voigt &to, const int steps) {
    for (int i = 1; i <= steps; ++i)
      {
        requested(*of, from + i / static_cast<double>(steps) * (to - from));
        of->commit();
      }
  };
  const base::Voigt open = 2e-3 * base::Voigt::Unit(0), closed = -2e-4 * base::Voigt::Unit(0);
  drive(base::Voigt::Zero(), open, 40);
  CHECK(of->record(0).damage > 0.1);
  const double softened = requested(*of, open + 1e-9 * base::Voigt::Unit(0)).tangent(0, 0);
  CHECK(softened < 0.2 * cell->stiffness()(0, 0));
  drive(open, closed, 40);
  const auto pushed = requested(*of, closed - 1e-9 * base::Voigt::Unit(0));
  CHECK(pushed.stress[0] < 0);
  CHECK(pushed.tangent(0, 0) > 0.3 * cell->stiffness()(0, 0)); // links that are closed push as if nothing had happened

  const double      before  = of->cell(0)->energy().friction;
  const base::Voigt sheared = closed + 5e-4 * base::Voigt::Unit(5);
  drive(closed, sheared, 10);
  CHECK(of->cell(0)->energy().friction > before);
  // Under twice the pressure it slides under more shear.
  const double shear = std::fabs(requested(*of, sheared).stress[5]);
  drive(sheared, sheared + closed, 10);
  drive(sheared + closed, sheared + closed + 5e-4 * base::Voigt::Unit(5), 10);
  CHECK(std::fabs(requested(*of, sheared + closed + 5e-4 * base::Voigt::Unit(5)).stress[5]) > 1.2 * shear);
  const dem::CellEnergy energy = of->cell(0)->energy();
  CHECK(std::fabs(energy.residual()) < 0.03 * energy.external_work);
}

TEST_CASE("cells with contacts: particles take over before two of them touch, and bear more than without",
          "[coupling][multiscale]")
{
  dem::CompactionParameters how;
  how.radius           = 1e-3;
  how.count            = 64;
  how.low_pressure     = 2e-2;
  dem::Packing packing = dem::compact(how).packing;
  for (std::size_t i = 0; i < packing.size(); i += 3)
    packing.radius[i] *= 0.99; // apart by half a per cent of the diameter, or twice that
  dem::CpmParameters unbreakable = concrete(1e3);
  unbreakable.cohesion           = 1e15;
  coupling::CellParameters p     = parameters(1e-10);
  p.links.interaction_ratio      = 1.001;
  const auto squeezed            = [](const double size) {
    return base::Voigt((base::Voigt() << -1, -1, -1, 0.1, 0, 0.2).finished() * size);
  };
  std::array<base::Voigt, 2> stress;
  for (const double reach : {0.0, 0.05})
    {
      p.links.contact_reach = reach;
      const auto cell       = std::make_shared<coupling::PreparedCell>(packing, unbreakable, p);
      CHECK((cell->waiting_contacts() > 0) == (reach > 0));
      auto of = points({cell});
      of->allocate(1);
      double size = 0;
      while (size < 8e-3)
        {
          size += of->promoted() == 0 ? 1e-5 : 2e-4;
          const base::Voigt elastic = cell->stiffness() * squeezed(size);
          const auto        answer  = requested(*of, squeezed(size));
          const bool        just    = of->promoted() == 0;
          of->commit();
          stress[reach > 0 ? 1 : 0] = answer.stress;
          if (just && of->promoted() == 1)
            {
              CHECK(cell->elastic_range()->nearest(squeezed(size)).exertion == Approx(0.95).margin(0.06));
              CHECK((answer.stress - elastic).norm() < 1e-9 * elastic.norm());
            }
        }
      CHECK(of->promoted() == (reach > 0 ? 1u : 0u));
      CHECK(of->record(0).damage == 0);
    }
  CHECK(stress[1].head<3>().sum() < 1.05 * stress[0].head<3>().sum()); // pressure is negative
}
