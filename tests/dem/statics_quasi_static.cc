// Quasi-static paths of CPM links, past the peak: cells and gripped specimens.
#include "dem/grips/grip_layers.h"
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/cpm.h"
#include "dem/packing/lattice.h"
#include "dem/specimen/specimen.h"
#include "dem/statics/quasi_static_path.h"
#include "memory_state.h"
#include "quasi_static_fixture.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace homogenisation_fixture;
using namespace quasi_static_fixture;

TEST_CASE("quasi-static cell: a cubic lattice follows the envelope of its links", "[dem][statics]")
{
  const auto law = concrete();
  const auto loaded =
    dem::load_cell(network_of(dem::make_lattice(dem::Lattice::simple_cubic, 1e-3, {1, 1, 1}), 1.05, law), 0, false);
  const auto path = follow(loaded, law, steps(30e-4));
  REQUIRE(path.size() > 20);
  for (const auto &point : path)
    {
      const double exact = M_PI / 4 * envelope(law, point.strain[0]);     // doc/theory/homogenisation.md, 5
      CHECK(point.stress[0] == Approx(exact).epsilon(1e-9).margin(1e-3)); // rounding; margin: the first point is zero
      CHECK(std::fabs(point.stress[1]) <= 1e-9 * exact + 1e-3);
    }
  CHECK(path.back().strain[0] >= 20e-4);
}

TEST_CASE("quasi-static specimen: two gripped spheres follow the envelope of their link, and its energy",
          "[dem][statics]")
{
  const auto law     = concrete();
  const auto loaded  = row(2, law);
  auto       p       = steps(60e-4);
  p.end_stress       = 0.05;
  p.growth_step      = 0.02;
  const auto   path  = follow(loaded, law, p);
  const double share = M_PI * 1e-6 / (loaded.volume / 2e-3); // of the link in the section, a convex hull of polygons
  CHECK(share == Approx(1).epsilon(0.02));
  for (const auto &point : path)
    CHECK(point.stress[0] == Approx(share * envelope(law, point.strain[0])).epsilon(1e-9).margin(1e-3));
  // Area under the envelope less what is stored, doc/theory/cpm.md, 3.
  const double kappa = path.back().strain[0];
  const double lost  = law.normal_modulus * 1e-4 * (0.5e-4 + 30e-4 * (1 - std::exp(-(kappa - 1e-4) / 30e-4))) -
                      0.5 * envelope(law, kappa) * kappa;
  CHECK(path.back().damage == Approx(lost * M_PI * 1e-6 * 2e-3).epsilon(1e-9));
  CHECK(path.back().balance_error() < 2e-4); // trapezoidal work: (step/eps_f)^2/12, steps of 2 % of up to 60 eps_0
}

TEST_CASE("quasi-static specimen: a crushed pair of spheres stays elastic", "[dem][statics]")
{
  const auto law    = concrete();
  const auto loaded = row(2, law);
  const auto path   = follow(loaded, law, steps(5e-3, -1));
  CHECK(path.back().strain[0] == Approx(-5e-3).epsilon(1e-12));
  CHECK(path.back().stress[0] * loaded.volume / 2e-3 == Approx(-5e-3 * law.normal_modulus * M_PI * 1e-6).epsilon(1e-9));
  CHECK(path.back().damage + path.back().friction == 0);
}

namespace
{
  /** Force of a chain of `links` equal links and a weak one of 0.8 times their section over its strain, the weak one open to kappa. */
  struct WeakChain
  {
    dem::CpmParameters law;
    int                others;
    double             area = M_PI * 1e-6;

    double force(const double kappa) const { return 0.8 * area * envelope(law, kappa); }
    double strain(const double kappa) const
    {
      return (kappa + others * force(kappa) / (area * law.normal_modulus)) / (others + 1);
    }
    double opening(const double force_now) const
    {
      return law.limit_elastic_strain -
             law.relative_ductility * law.limit_elastic_strain *
               std::log(force_now / (0.8 * area) / (law.normal_modulus * law.limit_elastic_strain));
    }
  };

  void weaken(dem::LoadedNetwork &loaded, const std::int32_t first)
  {
    auto &links = loaded.network.links;
    auto  weak  = std::find_if(links.begin(), links.end(),
                               [&](const auto &l) { return l.direction.x() > 0.9 && l.first == first; });
    REQUIRE(weak != links.end());
    weak->area *= 0.8;
    weak->stiffness *= 0.8;
  }
} // namespace

TEST_CASE("quasi-static path: a chain with a weak link snaps back along the closed form, in a cell and between grips",
          "[dem][statics]")
{
  // One link of 0.8 times the section, softening strain 3 eps_0: after the peak the seven others contract by more than the weak
  // one opens, 5.6/3 > 1, and the strain of the whole falls.
  const auto      law = concrete(3);
  const WeakChain chain{law, 7};
  for (const bool cell : {true, false})
    {
      dem::LoadedNetwork loaded =
        cell ? dem::load_cell(network_of(dem::make_lattice(dem::Lattice::simple_cubic, 1e-3, {8, 1, 1}), 1.05, law), 0,
                              false) :
               row(9, law);
      weaken(loaded, 3);
      auto p                = steps(10e-4);
      p.tolerance           = 1e-10;
      p.growth_step         = 0.05;
      p.end_stress          = 0.1;
      const auto   path     = follow(loaded, law, p);
      const double section  = cell ? 4e-6 : loaded.volume / 16e-3;
      double       at_onset = 0, least_strain = 1;
      for (const auto &point : path)
        {
          const double force     = point.stress[0] * section;
          const bool   softening = point.mean_damage > 0;
          const double kappa     = softening ? chain.opening(force) : force / (0.8 * chain.area * law.normal_modulus);
          const double exact     = (kappa + 7 * force / (chain.area * law.normal_modulus)) / 8;
          CHECK(point.strain[0] == Approx(exact).epsilon(1e-7).margin(1e-12)); // tolerance 1e-10 of the forces
          CHECK(point.control != dem::StepControl::relaxed);
          (softening ? least_strain : at_onset) = softening ? std::min(least_strain, point.strain[0]) : point.strain[0];
        }
      // Peak at (0.8 * 7 + 1)/8 eps_0. From there the strain falls until (5.6/3) exp(-(kappa - eps_0)/eps_f) = 1, where
      // kappa = 2.872 eps_0 and the strain is (2.872 + 3)/8 eps_0; steps of 5 % of kappa come near both.
      CHECK(at_onset == Approx(0.825e-4).epsilon(0.05));
      CHECK(least_strain == Approx(0.734e-4).epsilon(0.001));
      CHECK(path.back().stress[0] < 0.15 * peak(path));
      CHECK(path.back().balance_error() < 2e-3); // trapezoidal over steps of 5 %
    }
}

TEST_CASE("relaxation of links: a chain driven past its snap-back falls to the closed form's other branch",
          "[dem][statics]")
{
  const auto         law = concrete(3);
  const WeakChain    chain{law, 7};
  dem::LoadedNetwork loaded = row(9, law);
  weaken(loaded, 3);
  dem::DamagingLinks            links(loaded, law);
  dem::LoadedMotion             motion(9);
  dem::LinkRelaxationParameters p;
  p.tolerance = 1e-9;
  // Past the peak, (0.8 * 7 + 1)/8 eps_0, there is equilibrium at this strain only far down the softening branch.
  const double strain = 0.83e-4;
  const auto   report = dem::relax_links(loaded, links, motion, strain * base::Vector6::Unit(loaded.driven), p);
  REQUIRE(report.converged);
  double low = 2.872e-4, high = 100e-4; // strain of the chain grows with kappa here
  for (int i = 0; i < 100; ++i)
    (chain.strain(0.5 * (low + high)) < strain ? low : high) = 0.5 * (low + high);
  // The weak link overshoots the closed form, as anything that falls does, and then rests on its way back from there.
  const double force = links.forces().front().norm();
  CHECK(force < chain.force(low));
  CHECK(force > 0.5 * chain.force(low));
  double reached = 0;
  for (std::size_t i = 0; i < links.size(); ++i)
    reached = std::max(reached, links.reached(i));
  CHECK(reached > low);
  const double secant = chain.force(reached) / reached, whole = chain.area * law.normal_modulus; // force per strain
  CHECK(force == Approx(strain * 8 / (1 / secant + 7 / whole)).epsilon(1e-6));
  for (const Eigen::Vector3d &f : links.forces())
    CHECK(f.norm() == Approx(force).epsilon(1e-6));
  // With the energy that the fall set free, the account closes: explicit steps, second order in (step 1.6 over 2).
  const double spent = links.stored() + links.damage_work() + report.damped;
  CHECK(report.external_work == Approx(spent).epsilon(0.01));
  CHECK(report.damped > 0.01 * spent);
}

TEST_CASE("quasi-static cell: the first slope is the relaxed modulus, the free stresses vanish", "[dem][statics]")
{
  const auto    law    = concrete();
  const auto    loaded = random_cell(law);
  const Matrix6 C      = dem::relaxed_stiffness(loaded.network).stiffness.fullPivLu().inverse();
  const auto    path   = follow(loaded, law, steps(2e-5));
  CHECK(path[1].stress[0] / path[1].strain[0] == Approx(1 / C(0, 0)).epsilon(1e-7));
  CHECK(path[1].strain[1] / path[1].strain[0] == Approx(C(1, 0) / C(0, 0)).epsilon(1e-6));
  CHECK(path[1].stress.tail<5>().norm() < 1e-6 * path[1].stress[0]);
}

TEST_CASE("quasi-static specimen: the first slope is that of the linear solution with prescribed particles",
          "[dem][statics]")
{
  const auto law = concrete();
  for (const bool rough : {false, true})
    {
      const auto                   loaded = random_box(law, rough);
      const dem::StiffnessOperator K(loaded.network, loaded.held);
      const double                 strain = 1e-6;
      dem::LaneStrains             none;
      none.fill(base::Vector6::Zero());
      dem::Fields x(loaded.network.particles() * dem::motions * dem::load_lanes, 0.0), y(x.size());
      for (std::size_t k = 0; k < K.particles(); ++k)
        for (int c = 0; c < 3; ++c)
          x[(k * dem::motions + c) * dem::load_lanes] = strain * loaded.carried[K.order()[k]](c, 0);
      dem::SolverParameters solver;
      solver.tolerance  = 1e-12;
      const auto report = dem::solve_linear(K, {}, x, none, false, solver);
      REQUIRE(report.converged);
      K.apply(x, y);
      auto p      = steps(1e-5);
      p.tolerance = 1e-12;
      double work = 0; // of the supports
      for (std::size_t i = 0; i < x.size(); i += dem::load_lanes)
        work += x[i] * y[i];
      const auto path = follow(loaded, law, p);
      CHECK(path[1].stress[0] / path[1].strain[0] == Approx(work / (strain * strain * loaded.volume)).epsilon(1e-8));
    }
}

TEST_CASE("statics: a cantilever ladder of bonded spheres deflects by its closed form under a prescribed tip",
          "[dem][statics]")
{
  // tests/dem/cantilever.cc derives it: delta/F = n (4 n^2 - 1)/(6 k_N) + (6 n - 3)/(4 k_T).
  for (const int n : {1, 2, 4, 9})
    {
      dem::Packing packing;
      for (int row = 0; row < 2; ++row)
        for (int i = 0; i <= n; ++i)
          packing.centre.emplace_back(2.0 * i, 2.0 * row, 0);
      packing.radius.assign(packing.centre.size(), 1.0);
      const auto                    network = dem::make_network(packing, links(1.05, 0.2));
      std::vector<dem::HeldMotions> held(packing.size(), 0);
      held[0] = held[n + 1] = 0x3f;
      held[n] = held[2 * n + 1] = 0x2;
      const dem::StiffnessOperator K(network, held);
      dem::Fields                  x(packing.size() * dem::motions * dem::load_lanes, 0.0), y(x.size());
      dem::LaneStrains             none;
      none.fill(base::Vector6::Zero());
      const auto at = [&](const std::size_t particle) {
        const auto place = std::find(K.order().begin(), K.order().end(), static_cast<std::int32_t>(particle));
        return ((place - K.order().begin()) * dem::motions + 1) * dem::load_lanes;
      };
      x[at(n)] = x[at(2 * n + 1)] = 1e-3;
      dem::SolverParameters solver;
      solver.tolerance = 1e-13;
      REQUIRE(dem::solve_linear(K, {}, x, none, false, solver).converged);
      K.apply(x, y);
      const double k_N = M_PI / 2, k_T = 0.2 * k_N, force = y[at(n)] + y[at(2 * n + 1)];
      CHECK(1e-3 / force == Approx(n * (4.0 * n * n - 1) / (6 * k_N) + (6.0 * n - 3) / (4 * k_T)).epsilon(1e-9));
    }
}

TEST_CASE("quasi-static path: work is stored or dissipated, and the peak does not depend on the steps",
          "[dem][statics][slow]")
{
  const auto law = concrete();
  for (const bool cell : {true, false})
    {
      const auto loaded = cell ? random_cell(law) : random_box(law);
      auto       p      = steps(4e-4);
      p.strain_step     = 2e-5;
      const auto coarse = follow(loaded, law, p);
      p.strain_step     = 5e-6;
      const auto fine   = follow(loaded, law, p);
      CAPTURE(cell, coarse.size(), fine.size(), peak(coarse), peak(fine), coarse.back().balance_error(),
              fine.back().balance_error());
      CHECK(fine.back().damage > 0);
      CHECK(fine.back().balance_error() < 0.01); // trapezoidal work over a path with kinks, sliding by implicit steps
      CHECK(fine.back().balance_error() < coarse.back().balance_error());
      CHECK(peak(fine) == Approx(peak(coarse)).epsilon(0.005));
      for (std::size_t i = 1; i < fine.size(); ++i)
        {
          CHECK(fine[i].residual <= p.tolerance);
          CHECK(fine[i].damage >= fine[i - 1].damage);
          CHECK(fine[i].friction >= fine[i - 1].friction);
        }
    }
}

TEST_CASE("quasi-static path: in compression cracks run in cascades, which relaxation takes over and hands back",
          "[dem][statics][slow]")
{
  const auto law     = concrete();
  const auto loaded  = random_box(law);
  auto       p       = steps(1.2e-3, -1);
  p.strain_step      = 2e-5;
  const auto path    = follow(loaded, law, p);
  int        relaxed = 0, handed_back = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    {
      relaxed += path[i].control == dem::StepControl::relaxed;
      handed_back += path[i - 1].control == dem::StepControl::relaxed && path[i].control != dem::StepControl::relaxed;
      CHECK(path[i].residual <= p.tolerance);
      CHECK(path[i].damped >= path[i - 1].damped);
    }
  CAPTURE(path.size(), relaxed, handed_back, peak(path));
  CHECK(relaxed > 0);
  CHECK(handed_back > 0);
  CHECK(path.back().damped > 0);
  CHECK(path.back().balance_error() < 0.01);
}

TEST_CASE("quasi-static path: the same bits for one and two threads, and after a restart", "[dem][statics][S13]")
{
  const auto law         = concrete();
  const auto loaded      = random_cell(law);
  auto       p           = steps(3.5e-4);
  p.strain_step          = 4e-5;
  const auto state_after = [&](const int threads, const int restart_after) {
    omp_set_num_threads(threads);
    auto path = std::make_unique<dem::QuasiStaticPath>(loaded, law, p);
    for (int i = 0; i < 14; ++i)
      {
        if (i == restart_after)
          {
            MemoryState         memory;
            MemoryState::Writer writer(memory);
            path->visit_state(writer);
            path = std::make_unique<dem::QuasiStaticPath>(loaded, law, p);
            MemoryState::Reader reader(memory);
            path->visit_state(reader);
          }
        path->advance();
      }
    MemoryState         memory;
    MemoryState::Writer writer(memory);
    path->visit_state(writer);
    omp_set_num_threads(1);
    return memory;
  };
  const MemoryState reference = state_after(1, -1);
  CHECK(reference.numbers.at("lost_by_damage") > 0);
  CHECK(state_after(2, -1) == reference);
  CHECK(state_after(1, 9) == reference);
}

TEST_CASE("quasi-static path: what cannot be followed is refused", "[dem][statics][S14]")
{
  const auto law    = concrete();
  const auto loaded = row(3, law);
  auto       p      = steps(1e-4);
  p.strain_step     = 0;
  CHECK_THROWS_WITH(dem::QuasiStaticPath(loaded, law, p), Catch::Contains("Strain step = 0"));
  p            = steps(1e-4);
  p.end_stress = 1;
  CHECK_THROWS_WITH(dem::QuasiStaticPath(loaded, law, p), Catch::Contains("End stress = 1"));
  CHECK_THROWS_WITH(dem::load_cell(loaded.network, 0, true), Catch::Contains("no periodic cell"));
  dem::GripPair grips;
  grips.axis            = 0;
  grips.layers.low      = {0};
  grips.layers.high     = {0};
  grips.layers.distance = 1;
  grips.layers.section  = 1;
  CHECK_THROWS_WITH(dem::load_grips(loaded.network, grips), Catch::Contains("particle 1"));
}

TEST_CASE("quasi-static cell: dynamic strengths fall towards the static one as the rate falls", "[dem][statics][slow]")
{
  const auto   law     = concrete();
  const auto   packing = millimetres(random_spheres(64, 3));
  const double still   = peak(follow(random_cell(law, false), law, steps(6e-4)));

  const auto dynamic = [&](const double rate) {
    dem::SpecimenParameters s;
    s.physics.periodic  = true;
    s.physics.contacts  = false;
    s.density           = 4800;
    s.interaction_ratio = 1.6;
    s.damping           = 0.3;
    dem::Specimen body(packing, s, law);
    body.set_velocity_gradient(rate * Eigen::Vector3d(1, 0, 0) * Eigen::RowVector3d(1, 0, 0));
    double largest = 0;
    while (body.time() * rate < 6e-4)
      {
        body.advance(1);
        largest = std::max(largest, body.cell().stress(0, 0));
      }
    return largest;
  };
  const double fast = dynamic(30), slow = dynamic(3), slowest = dynamic(0.3);
  CAPTURE(still, fast, slow, slowest);
  CHECK(std::fabs(slow - still) < std::fabs(fast - still));
  CHECK(slowest == Approx(still).epsilon(0.01)); // finite against small strain: parts in 1e-4; the rate: what is left
}

TEST_CASE("a path of particles that are all driven is that of their links", "[dem][statics]")
{
  // Two spheres, each in a grip: no motion is left to solve for.
  const dem::CpmParameters law = concrete();
  const double             r   = 0.01;
  dem::Packing             pair;
  pair.centre = {{0, 0, 0}, {0, 0, 2 * r}};
  pair.radius = {r, r};
  dem::GripParameters ends;
  ends.thickness = 0.5 * r;
  dem::GripPair grips;
  grips.axis            = 2;
  grips.lateral_blocked = grips.spin_blocked = true;
  grips.layers                               = dem::find_grip_layers({pair.centre, pair.radius, 3, 0}, 2, ends);
  const dem::LoadedNetwork loaded            = dem::load_grips(network_of(pair, 1.05, law), grips);
  const auto               path              = follow(loaded, law, steps(5e-4));
  REQUIRE(path.size() > 10);
  double most = 0;
  for (const dem::QuasiStaticPoint &point : path)
    {
      const double strain = point.strain[loaded.driven], stress = point.stress[loaded.driven];
      if (strain > 0 && strain <= law.limit_elastic_strain)
        CHECK(stress / strain == Approx(path[1].stress[loaded.driven] / path[1].strain[loaded.driven]).epsilon(1e-9));
      most = std::max(most, stress);
    }
  CHECK(most ==
        Approx(path[1].stress[loaded.driven] / path[1].strain[loaded.driven] * law.limit_elastic_strain).epsilon(1e-3));
  CHECK(path.back().stress[loaded.driven] < 0.99 * most); // it softens
}
