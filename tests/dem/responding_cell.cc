// A periodic cell as a material point: strain in, stress and consistent tangent out.
#include "dem/cells/responding_cell.h"

#include "clusters.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/cpm.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/lattice.h"
#include "dem/statics/quasi_static_path.h"
#include "memory_state.h"
#include "tests/dem/homogenisation_fixture.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <memory>

using namespace homogenisation_fixture;
using cluster::concrete;

namespace
{
  std::shared_ptr<const dem::LoadedNetwork>
  random_cell(const dem::LinkMaterials &law, const int dimension = 3, const std::uint64_t seed = 3)
  {
    dem::Packing           packing = dimension == 3 ? random_spheres(48, seed) : six_discs();
    dem::NetworkParameters p       = dimension == 3 ? links(1.6, 0.2, 25e9) : plane_links(1.6, 0.2, 1.0, 25e9);
    return std::make_shared<dem::LoadedNetwork>(dem::strained_cell(dem::make_network(packing, p, law)));
  }

  dem::CellResponseParameters tight_control()
  {
    dem::CellResponseParameters p;
    p.tolerance = 1e-12;
    return p;
  }

  base::Vector6 mixed(const double size)
  {
    return (base::Vector6() << 1.0, -0.3, 0.2, 0.4, -0.2, 0.5).finished() * size;
  }

  /** Central differences of the response, from the committed state. */
  base::Matrix6 differences(const dem::RespondingCell &cell, const base::Vector6 &strain, const double step)
  {
    base::Matrix6 D;
    for (int c = 0; c < 6; ++c)
      {
        dem::RespondingCell up = cell, down = cell;
        D.col(c) = (up.respond(strain + step * base::Vector6::Unit(c)).stress -
                    down.respond(strain - step * base::Vector6::Unit(c)).stress) /
                   (2 * step);
      }
    return D;
  }
} // namespace

TEST_CASE("responding cell: an elastic step gives the relaxed stiffness, and the stress that it says", "[dem][statics]")
{
  const auto          cell = random_cell(concrete());
  const base::Matrix6 D    = dem::relaxed_stiffness(cell->network).stiffness;
  dem::RespondingCell point(cell, concrete(), tight_control());
  const base::Vector6 strain = mixed(2e-5);
  const auto          answer = point.respond(strain);
  CHECK(relative_difference(answer.tangent, D) < 1e-10);
  CHECK((answer.stress - D * strain).norm() < 1e-10 * (D * strain).norm());
  CHECK(answer.parts == 1);
  point.commit();
  const dem::CellEnergy energy = point.energy();
  CHECK(energy.stored == Approx(0.5 * cell->volume * strain.dot(D * strain)).epsilon(1e-9));
  CHECK(std::fabs(energy.residual()) < 1e-9 * energy.stored);
  CHECK(energy.damage + energy.friction + energy.damped == 0);
}

TEST_CASE("responding cell: in the plane too, where only in-plane strains exist", "[dem][statics]")
{
  const auto          cell = random_cell(concrete(), 2);
  const base::Matrix6 D    = dem::relaxed_stiffness(cell->network).stiffness;
  dem::RespondingCell point(cell, concrete(), tight_control());
  base::Vector6       strain = base::Vector6::Zero();
  strain << 2e-5, -1e-5, 0, 0, 0, 1e-5;
  const auto answer = point.respond(strain);
  CHECK(relative_difference(answer.tangent, D) < 1e-10);
  CHECK((answer.stress - D * strain).norm() < 1e-10 * (D * strain).norm());
  CHECK_THROWS_WITH(point.respond(base::Vector6::Unit(2) * 1e-5), Catch::Contains("in the plane"));
}

TEST_CASE("responding cell: strained in steps it follows the quasi-static path of the same strains", "[dem][statics]")
{
  const auto                 cell = random_cell(concrete());
  dem::QuasiStaticParameters p;
  p.strain_step = 1e-5;
  p.end_strain  = 4e-4;
  p.tolerance   = 1e-11;
  dem::QuasiStaticPath path(*cell, concrete(), p);
  dem::RespondingCell  point(cell, concrete(), tight_control());
  std::size_t          compared = 0;
  while (!path.finished())
    {
      const auto reference = path.advance();
      if (reference.control == dem::StepControl::relaxed)
        break; // past the peak: a cascade ends where the last push has led it
      ++compared;
      const auto answer = point.respond(reference.strain);
      point.commit();
      CHECK((answer.stress - reference.stress).norm() < 1e-7 * reference.stress.norm());
    }
  CHECK(compared > 20);
  CHECK(point.links().mean_damage() > 0.02);
  const dem::QuasiStaticPoint &last = path.points()[compared];
  CHECK(point.energy().damage == Approx(last.damage).epsilon(1e-6));
  CHECK(point.energy().external_work == Approx(last.external_work).epsilon(1e-6));
}

TEST_CASE("responding cell: the tangent is the derivative, with damage and sliding under way", "[dem][statics]")
{
  for (const double sign : {1.0, -1.0})
    {
      dem::RespondingCell point(random_cell(concrete()), concrete(), tight_control());
      point.respond(mixed(sign * 2e-4));
      point.commit();
      const base::Vector6 strain = mixed(sign * 2.3e-4);
      dem::RespondingCell trial  = point;
      const auto          answer = trial.respond(strain);
      trial.commit();
      CHECK(trial.links().mean_damage() > point.links().mean_damage());
      CHECK(relative_difference(answer.tangent, differences(point, strain, 1e-9)) < 1e-6);
      const double elastic = relative_difference(answer.tangent, point.respond(point.strain()).tangent);
      CHECK(elastic > 1e-3); // the branch matters
    }
}

TEST_CASE("responding cell: a law with moments answers with its tangent too", "[dem][statics]")
{
  dem::ParallelBondParameters bond;
  bond.effective_modulus = bond.bond_effective_modulus = 10e9;
  bond.tensile_strength                                = 1e9;
  bond.cohesion                                        = 1e9;
  const auto          cell                             = random_cell(bond);
  const base::Matrix6 D                                = dem::relaxed_stiffness(cell->network).stiffness;
  dem::RespondingCell point(cell,
                            bond); // the overlap is a difference of lengths: tighter than 1e-9 is below their rounding
  const auto          answer = point.respond(mixed(1e-4));
  CHECK(relative_difference(answer.tangent, differences(point, mixed(1e-4), 1e-7)) < 1e-6);
  // The relaxed stiffness is that of the links as they were made: with the contact where it is closed.
  CHECK(answer.tangent(0, 0) > 0.5 * D(0, 0));
}

TEST_CASE("responding cell: a trial leaves no trace, a copy and a restored state go on to the same bits",
          "[dem][statics]")
{
  dem::RespondingCell point(random_cell(concrete()), concrete());
  point.respond(mixed(2e-4));
  point.commit();
  dem::RespondingCell copy = point, fresh(random_cell(concrete()), concrete());
  MemoryState         saved;
  MemoryState::Writer writer(saved);
  point.visit_state(writer);
  MemoryState::Reader reader(saved);
  fresh.visit_state(reader);
  point.respond(mixed(-9e-4)); // tried, not taken
  const auto answer = point.respond(mixed(3e-4));
  for (dem::RespondingCell *other : {&copy, &fresh})
    {
      const auto again = other->respond(mixed(3e-4));
      CHECK(again.stress == answer.stress);
      CHECK(again.tangent == answer.tangent);
    }
  omp_set_num_threads(2);
  const auto by_two = copy.respond(mixed(3e-4));
  omp_set_num_threads(1);
  CHECK(by_two.stress == answer.stress);
}

TEST_CASE("responding cell: Newton's method on its stress converges with the square of the error", "[dem][statics]")
{
  // Uniaxial stress: the other five components are to vanish, as for a point of a structure; damage is under way.
  dem::RespondingCell point(random_cell(concrete()), concrete(), tight_control());
  base::Vector6       strain = base::Vector6::Zero();
  std::vector<double> error;
  int                 parts = 0;
  for (const double axial : {0.9e-4, 1.2e-4, 1.4e-4})
    {
      strain[0] = axial;
      error.clear();
      for (int i = 0; i < 12; ++i)
        {
          const auto answer = point.respond(strain);
          parts             = answer.parts;
          error.push_back(answer.stress.tail<5>().norm() / answer.stress.norm());
          if (error.back() < 1e-11)
            break;
          strain.tail<5>() -= answer.tangent.bottomRightCorner<5, 5>().fullPivLu().solve(answer.stress.tail<5>());
        }
      REQUIRE(error.back() < 1e-11);
      point.commit();
    }
  CHECK(point.links().mean_damage() > 0.01);
  // Where links change their branch the first steps do not count; the last pair above rounding shows the order.
  std::size_t last = error.size() - 1;
  while (last > 0 && error[last] < 1e-9)
    --last;
  REQUIRE(last + 1 < error.size());
  const double order = std::log(error[last + 1]) / std::log(error[last]);
  UNSCOPED_INFO("errors end with " << error[last] << ", " << error[last + 1] << ": order " << order);
  CHECK(parts == 1); // else the tangent would be that of the last part
  CHECK(order > 1.7);
  CHECK(order < 2.5); // the constant before the square is below one, which adds some tenths
}

TEST_CASE("responding cell: a strain far past the peak in one call is answered in parts, with the energy closed",
          "[dem][statics][slow]")
{
  dem::RespondingCell once(random_cell(concrete()), concrete()), often = once;
  const base::Vector6 end    = base::Vector6::Unit(0) * 12e-4;
  const auto          answer = once.respond(end);
  once.commit();
  CHECK(answer.parts > 1);
  base::Vector6 stress;
  for (int i = 1; i <= 120; ++i)
    {
      stress = often.respond(i / 120.0 * end).stress;
      often.commit();
    }
  CHECK(answer.stress[0] == Approx(stress[0]).epsilon(0.05));
  for (const auto *cell : {&once, &often})
    {
      const dem::CellEnergy e = cell->energy();
      CHECK(e.damage > 0.5 * e.external_work);
      CHECK(std::fabs(e.residual()) < (cell == &once ? 0.1 : 1e-2) * e.external_work);
    }
}

TEST_CASE("responding cell: once it has fallen in a step its answers are smooth, until another step is sought",
          "[dem][statics][slow]")
{
  dem::CellResponseParameters falls = {};
  falls.keeps_its_way               = true;
  dem::RespondingCell rough(random_cell(concrete()), concrete()), smooth(random_cell(concrete()), concrete(), falls);
  base::Vector6       strain = base::Vector6::Zero();
  dem::CellResponse   fall;
  for (int i = 1; i <= 200 && fall.relaxation_steps == 0; ++i)
    {
      rough.commit();
      smooth.commit();
      strain = i * 1e-5 * base::Vector6::Unit(0);
      fall   = smooth.respond(strain);
      CHECK(rough.respond(strain).stress == fall.stress); // the fall itself is the same
    }
  REQUIRE(fall.relaxation_steps > 0);

  // Nearby strains: no more cascades, and a difference that the tangent explains. From the committed state each falls on its own.
  const base::Vector6     aside = strain + 1e-8 * mixed(1);
  const dem::CellResponse near = smooth.respond(aside), again = smooth.respond(strain);
  CHECK(near.relaxation_steps == 0);
  CHECK(rough.respond(aside).relaxation_steps > 0);
  CHECK((near.stress - again.stress - near.tangent * (aside - strain)).norm() < 1e-8 * fall.stress.norm());

  smooth.begin_step();
  CHECK(smooth.respond(strain).stress == fall.stress);
  smooth.respond(aside);
  smooth.commit();
  CHECK(std::fabs(smooth.energy().residual()) < 0.02 * smooth.energy().external_work);
}

TEST_CASE("responding cell: where a step was taken in parts strains near by are sought from the last, and are as good",
          "[dem][statics]")
{
  dem::CellResponseParameters keeps = tight_control();
  keeps.keeps_its_way               = true;
  dem::RespondingCell cell(random_cell(concrete()), concrete(), keeps);
  cell.respond(mixed(1e-4));
  cell.commit();
  const base::Vector6     strain = mixed(2.5e-4), aside = 1.01 * strain;
  dem::RespondingCell     at_once = cell;
  const dem::CellResponse first = cell.respond(strain), near = cell.respond(aside), alone = at_once.respond(aside);
  REQUIRE(first.parts > 1);
  REQUIRE(alone.parts > 1);
  CHECK(near.parts == 1);
  CHECK(near.iterations < alone.iterations / 3);
  // The way there differs a little, and so does what slid on it.
  CHECK((near.stress - alone.stress).norm() < 1e-2 * alone.stress.norm());
  // The tangent is that of the answers near by.
  base::Matrix6    D;
  constexpr double h = 1e-9;
  for (int c = 0; c < 6; ++c)
    D.col(c) = (cell.respond(aside + h * base::Vector6::Unit(c)).stress -
                cell.respond(aside - h * base::Vector6::Unit(c)).stress) /
               (2 * h);
  CHECK(relative_difference(near.tangent, D) < 1e-6);
  cell.respond(aside);
  cell.commit();
  CHECK(std::fabs(cell.energy().residual()) < 0.05 * cell.energy().external_work);
  // Another step knows nothing of it.
  dem::RespondingCell again = at_once;
  again.respond(strain);
  again.begin_step();
  CHECK(again.respond(aside).stress == alone.stress);
}

TEST_CASE("responding cell: unusable parameters are refused", "[dem][statics]")
{
  const auto                  cell = random_cell(concrete());
  dem::CellResponseParameters p;
  p.tolerance = 1;
  CHECK_THROWS_WITH(dem::RespondingCell(cell, concrete(), p), Catch::Contains("tolerance = 1"));
  dem::RespondingCell point(cell, concrete());
  CHECK_THROWS_WITH(point.respond(base::Vector6::Constant(std::nan(""))), Catch::Contains("must be finite"));
}
