// Particles of a cell that no link joins, and that come to touch under strain.
#include "dem/network/waiting_contacts.h"

#include "dem/cells/responding_cell.h"
#include "dem/laws/cpm.h"
#include "dem/laws/parallel_bond.h"
#include "dem/loading/periodic_cell.h"
#include "dem/packing/compaction.h"
#include "memory_state.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

namespace
{
  constexpr double modulus = 25e9, shear_ratio = 0.2, friction = 0.3;

  dem::CpmParameters unbreakable()
  {
    dem::CpmParameters p;
    p.normal_modulus       = modulus;
    p.shear_ratio          = shear_ratio;
    p.limit_elastic_strain = 1e3;
    p.relative_ductility   = 30;
    p.cohesion             = 1e15;
    p.friction_coefficient = friction;
    return p;
  }

  dem::NetworkParameters linked(const double ratio, const double reach)
  {
    dem::NetworkParameters p = homogenisation_fixture::links(ratio, shear_ratio, modulus);
    p.contact_reach          = reach;
    return p;
  }

  std::shared_ptr<const dem::LoadedNetwork>
  cell_of(const dem::Packing &packing, const dem::NetworkParameters &p, const dem::LinkMaterials &law = unbreakable())
  {
    return std::make_shared<dem::LoadedNetwork>(dem::strained_cell(dem::make_network(packing, p, law)));
  }

  dem::CellResponseParameters tight()
  {
    dem::CellResponseParameters p;
    p.tolerance = 1e-12;
    return p;
  }

  constexpr double gap = 1e-3;

  /** Layers of two by two touching spheres of diameter 1; pairs of layers touch too, and are a gap apart from the next pair. */
  dem::Packing layers()
  {
    dem::Packing p;
    for (const double x : {0.2, 1.2})
      for (const double y : {0.3, 1.3})
        for (const double z : {0.4, 1.4})
          p.centre.push_back({x, y, z});
    p.radius.assign(p.centre.size(), 0.5);
    p.periodic_cell = Eigen::Vector3d(2 + gap, 2, 2);
    return p;
  }

  dem::Packing compacted()
  {
    dem::CompactionParameters p;
    p.radius       = 1e-3;
    p.count        = 64;
    p.seed         = 5;
    p.low_pressure = 2e-2;
    return dem::compact(p).packing;
  }

  /** The same, every third sphere smaller by so much that those that have touched it are apart. */
  dem::Packing uneven()
  {
    dem::Packing p = compacted();
    for (std::size_t i = 0; i < p.size(); i += 3)
      p.radius[i] *= 1 - 0.02;
    return p;
  }

  /** How many contacts are closed in the state of a cell. */
  int closed(const dem::RespondingCell &cell, const dem::LoadedNetwork &loaded)
  {
    int n = 0;
    for (std::size_t l = 0; l < loaded.network.links.size(); ++l)
      n += loaded.network.links[l].waits && cell.links().normal_strain(l) < 0 ? 1 : 0;
    return n;
  }

  base::Vector6 squeeze() { return (base::Vector6() << -1, -0.8, -0.9, -0.1, 0, -0.2).finished() * 3e-4; }

  /** A cell of such spheres, those that touch linked; in a state in which some contacts are closed. */
  dem::RespondingCell squeezed(const std::shared_ptr<const dem::LoadedNetwork> &loaded, const dem::LinkMaterials &law)
  {
    dem::RespondingCell cell(loaded, law, tight());
    for (int i = 1; i <= 5; ++i)
      {
        cell.respond(i * squeeze());
        cell.commit();
      }
    return cell;
  }
} // namespace

TEST_CASE(
  "waiting contacts: layers bear nothing until their gap is closed, then in series, and slide by their friction",
  "[dem][statics]")
{
  dem::NetworkParameters p = linked(1.0005, 0.01);
  p.rotations              = false;
  const auto cell          = cell_of(layers(), p);
  CHECK(cell->network.bonds() == 4 + 8 + 8);
  CHECK(cell->network.links.size() == cell->network.bonds() + 4);
  dem::RespondingCell point(cell, unbreakable(), tight());
  const double        length = 2 + gap, stiffness = modulus * M_PI / 4; // of a bond and of a contact [N/m]
  // Pulled along y besides, so that there are forces at all.
  const auto squeezed = [](const double strain) { return (base::Vector6() << -strain, 1e-5, 0, 0, 0, 0).finished(); };
  CHECK(std::fabs(point.respond(squeezed(0.9 * gap / length)).stress[0]) < 1e-9 * stiffness * gap);
  point.commit();
  const double strain = 3 * gap / length, force = 2 * gap * stiffness / 2; // of each of four rows
  CHECK(point.respond(squeezed(strain)).stress[0] == Approx(-force).epsilon(1e-9));
  point.commit();
  CHECK(point.links().mean_damage() == 0);

  // Sheared: bonds and contacts along x in series, up to the friction; the bonds along y beside them.
  const double shear_stiffness = shear_ratio * stiffness, slips_at = friction * force / (shear_stiffness / 2);
  for (const double slip : {0.5 * slips_at, 3 * slips_at})
    {
      base::Vector6 e       = squeezed(strain);
      e[5]                  = 2 * slip / length;
      const double along_x  = std::min(shear_stiffness / 2 * slip, friction * force);
      const double along_y  = shear_stiffness * slip / length;
      const double expected = (4 * along_x * length / 2 + 8 * along_y / 2) / (4 * length);
      CHECK(point.respond(e).stress[5] == Approx(expected).epsilon(1e-9));
    }
  point.commit();
  CHECK(point.energy().friction == Approx(4 * friction * force * 2 * slips_at).epsilon(1e-9));

  // Opened again: nothing is left but the bonds along y, and the shear that the contacts had stored is lost.
  base::Vector6 open              = base::Vector6::Zero();
  open[5]                         = 6 * slips_at / length;
  const double stored_in_contacts = 4 * 0.5 * std::pow(friction * force, 2) / shear_stiffness;
  const double lost_before        = point.energy().friction;
  CHECK(point.respond(open).stress[0] == Approx(0).margin(1e-9 * stiffness * gap));
  point.commit();
  CHECK(point.energy().friction == Approx(lost_before + stored_in_contacts).epsilon(1e-9));
}

TEST_CASE("waiting contacts: a squeezed cell is as stiff as a specimen in motion that finds its contacts itself",
          "[dem][statics]")
{
  const dem::Packing packing = uneven();
  const double       size    = 0.008;
  base::Vector6      strain  = base::Vector6::Zero();
  strain.head<3>().setConstant(-size);
  const auto stress_with = [&](const double reach) {
    dem::RespondingCell point(cell_of(packing, linked(1.003, reach)), unbreakable(), tight());
    base::Vector6       stress;
    for (int i = 1; i <= 8; ++i)
      {
        stress = point.respond(i / 8.0 * strain).stress;
        point.commit();
      }
    return stress.head<3>().sum() / 3;
  };
  dem::SpecimenParameters how;
  how.physics.periodic  = true;
  how.density           = 2400;
  how.damping           = 0.3;
  how.interaction_ratio = 1.003;
  dem::Specimen           moving(packing, how, unbreakable());
  dem::CellTestParameters slowly;
  dem::CellLeg            there, rest;
  there.duration = 20000 * moving.time_step();
  there.target   = strain;
  rest.duration  = 5000 * moving.time_step();
  rest.target    = strain;
  slowly.path    = {there, rest};
  dem::CellTest test(moving, slowly);
  while (!test.finished())
    test.advance(1000);
  const double in_motion = test.curve().back().stress.head<3>().sum() / 3;
  const double touching = stress_with(0.1), apart = stress_with(0);
  INFO("in motion " << in_motion << ", with contacts " << touching << ", without " << apart);
  // Small strains here, the geometry of a cell that has shrunk there.
  CHECK(touching == Approx(in_motion).epsilon(0.03));
  CHECK(apart / touching < 0.9);
}

TEST_CASE("waiting contacts: the tangent is the derivative where particles come to touch, and the account closes",
          "[dem][statics]")
{
  dem::ParallelBondParameters bonds;
  bonds.effective_modulus      = 1e9;
  bonds.bond_effective_modulus = 1e9;
  bonds.tensile_strength       = 1e12;
  bonds.cohesion               = 1e12;
  bonds.friction_coefficient   = friction;
  for (const dem::LinkMaterials &law : {dem::LinkMaterials(unbreakable()), dem::LinkMaterials(bonds)})
    {
      const auto          loaded = cell_of(uneven(), linked(1.003, 0.1), law);
      dem::RespondingCell cell   = squeezed(loaded, law);
      bool                found  = false;
      const double        before = cell.energy().friction;
      for (int i = 6; i < 30; ++i)
        {
          const base::Vector6 there  = i * squeeze();
          const auto          answer = cell.respond(there);
          dem::RespondingCell then   = cell;
          then.commit();
          if (!found && answer.parts == 1 && closed(cell, *loaded) > 0 && closed(then, *loaded) > closed(cell, *loaded))
            {
              found = true;
              base::Matrix6    D;
              constexpr double h = 1e-9;
              for (int c = 0; c < 6; ++c)
                D.col(c) = (cell.respond(there + h * base::Vector6::Unit(c)).stress -
                            cell.respond(there - h * base::Vector6::Unit(c)).stress) /
                           (2 * h);
              CHECK(homogenisation_fixture::relative_difference(answer.tangent, D) < 1e-6);
            }
          cell = then;
        }
      CHECK(found);
      CHECK(cell.energy().friction > before);
      CHECK(std::fabs(cell.energy().residual()) < 2e-3 * cell.energy().external_work);
    }
}

TEST_CASE("waiting contacts: a cell goes on from a saved state to the same bits", "[dem][statics]")
{
  const auto          loaded = cell_of(uneven(), linked(1.003, 0.1));
  dem::RespondingCell one    = squeezed(loaded, unbreakable()), two(loaded, unbreakable(), tight());
  MemoryState         saved;
  MemoryState::Writer writer(saved);
  one.visit_state(writer);
  MemoryState::Reader reader(saved);
  two.visit_state(reader);
  const base::Vector6 there = 1.3 * one.strain();
  const auto          a = one.respond(there), b = two.respond(there);
  CHECK(a.stress == b.stress);
  CHECK(a.tangent == b.tangent);
}
