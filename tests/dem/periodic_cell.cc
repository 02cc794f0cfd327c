#include "base/errors.h"
#include "dem/measures/couple_stress.h"
#include "dem/measures/stress.h"
#include "periodic_cell_fixture.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

using namespace periodic_fixture;
using Catch::Contains;

namespace
{
  /** Mean Young's modulus and Poisson's ratio by the orthotropic reading (doc/theory/homogenisation.md, 4). */
  Eigen::Vector2d constants(const base::Matrix6 &stiffness)
  {
    const base::Matrix6 c = stiffness.inverse();
    double              e = 0, nu = 0;
    for (int i = 0; i < 3; ++i)
      {
        e += 1 / c(i, i) / 3;
        for (int j = 0; j < 3; ++j)
          if (j != i)
            nu -= c(j, i) / c(i, i) / 6;
      }
    return {e, nu};
  }
} // namespace

TEST_CASE("a strained lattice answers with its exact stiffness, whatever images its links reach", "[dem][periodic]")
{
  // doc/theory/homogenisation.md, 5. One sphere alone in its cell has links to its own images only.
  const double       En = 1, Gn = 0.3, a = M_PI / (2 * std::sqrt(2.0));
  const dem::Packing cubic  = lattice({{0.2, 0.7, 0.1}}, 2.0),
                     face   = lattice({{0, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}, 2 * std::sqrt(2.0));
  base::Matrix6 exact_cubic = base::Matrix6::Zero(), exact_face = base::Matrix6::Zero();
  for (int i = 0; i < 3; ++i)
    {
      exact_cubic(i, i)         = M_PI / 4 * En;
      exact_cubic(3 + i, 3 + i) = M_PI / 8 * Gn;
      for (int j = 0; j < 3; ++j)
        exact_face(i, j) = i == j ? a * (En + Gn) : a / 2 * (En - Gn);
      exact_face(3 + i, 3 + i) = a / 2 * (En + Gn);
    }
  const auto check = [&](const dem::Packing &packing, const base::Matrix6 &exact) {
    const auto make = [&] { return dem::Specimen(packing, elastic(1.1), unit_links(Gn)); };
    REQUIRE((make().affine_stiffness() - exact).cwiseAbs().maxCoeff() < 1e-14);
    for (int c = 0; c < 6; ++c)
      // Round-off of a strain of 1e-5: 1e-16/1e-5, some tens of it; its square from finite strain: 1e-10.
      REQUIRE((stiffness_column(make, c, 1e-5, 0) - exact.col(c)).cwiseAbs().maxCoeff() < 1e-9);
  };
  check(cubic, exact_cubic);
  check(face, exact_face);
}

TEST_CASE("eight spheres relax to their static stiffness", "[dem][periodic]")
{
  const auto          make  = [] { return dem::Specimen(eight_spheres(), elastic(1.5), unit_links(0.2)); };
  const base::Matrix6 exact = eight_spheres_stiffness();
  REQUIRE(make().counts().links == 37);
  const Eigen::Vector2d affine = constants(make().affine_stiffness());
  REQUIRE(affine[0] == Approx(0.624201).margin(5e-7));
  REQUIRE(affine[1] == Approx(0.181831).margin(5e-7));
  for (int c = 0; c < 6; ++c)
    // Seven printed digits: 5e-8 of numbers below 0.7; finite strain adds the square of 1e-5.
    CHECK((stiffness_column(make, c, 1e-5, 1e-10) - exact.col(c)).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("particles of a cell move with its gradient, and their fluctuation is kicked by their forces alone",
          "[dem][periodic]")
{
  dem::SpecimenParameters undamped = elastic(1.5);
  undamped.damping                 = 0;
  dem::Specimen           specimen(eight_spheres(), undamped, unit_links(0.2));
  dem::CellTestParameters p;
  base::Vector6           strain;
  strain << 0.02, -0.01, 0.03, 0.01, -0.02, 0.04;
  const double dt = specimen.time_step();
  p.path          = {strain_leg(40 * dt, strain)};
  dem::CellTest test(specimen, p);
  test.advance(10);
  for (int step = 0; step < 5; ++step)
    {
      std::vector<dem::ParticleState> before;
      for (std::size_t i = 0; i < 8; ++i)
        before.push_back(specimen.particle(i));
      const Eigen::Matrix3d then = specimen.cell().deformation;
      test.advance(1);
      const Eigen::Matrix3d gradient =
        (specimen.cell().deformation * then.inverse() - Eigen::Matrix3d::Identity()) / dt;
      std::vector<Eigen::Vector3d> force(8, Eigen::Vector3d::Zero());
      const dem::LinkOutput        links = specimen.links();
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          force[links.ends[l][0]] += links.load[l].force;
          force[links.ends[l][1]] -= links.load[l].force;
        }
      for (std::size_t i = 0; i < 8; ++i)
        {
          const dem::ParticleState now  = specimen.particle(i);
          const Eigen::Vector3d    kick = dt / now.mass * force[i],
                                way     = dt * (gradient * before[i].position + now.velocity);
          CHECK(kick.norm() > 0);
          CHECK((now.velocity - before[i].velocity - kick).norm() < 1e-9 * kick.norm());
          CHECK((now.moved - way).norm() < 1e-9 * way.norm());
        }
    }
}

TEST_CASE("eight spheres that cannot turn are stiffer, as the static solution says", "[dem][periodic]")
{
  dem::SpecimenParameters parameters = elastic(1.5);
  parameters.physics.rotations       = false;
  const auto    make                 = [&] { return dem::Specimen(eight_spheres(), parameters, unit_links(0.2)); };
  base::Matrix6 stiffness;
  for (int c = 0; c < 6; ++c)
    stiffness.col(c) = stiffness_column(make, c, 1e-5, 1e-10);
  const Eigen::Vector2d found = constants(stiffness);
  CHECK(found[0] == Approx(0.579927).margin(1e-6));
  CHECK(found[1] == Approx(0.186597).margin(1e-6));
  CHECK((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("six discs relax to their static stiffness in the plane", "[dem][periodic]")
{
  const auto make = [] { return dem::Specimen(six_discs(), elastic(1.25, 2), unit_links(0.2)); };
  REQUIRE(make().counts().links == 14);
  Eigen::Matrix3d exact, affine, found;
  exact << 0.829303, 0.298229, -0.033431, 0.298229, 0.968785, -0.022261, -0.033431, -0.022261, 0.259156;
  affine << 1.079166, 0.277155, -0.038675, 0.277155, 0.995181, -0.010888, -0.038675, -0.010888, 0.408588;
  const int at[3] = {0, 1, 5};
  for (int i = 0; i < 3; ++i)
    {
      const base::Vector6 column = stiffness_column(make, at[i], 1e-5, 1e-10);
      for (int j = 0; j < 3; ++j)
        {
          found(j, i) = column[at[j]];
          CHECK(make().affine_stiffness()(at[j], at[i]) == Approx(affine(j, i)).margin(1e-6));
        }
    }
  CHECK((found - exact).cwiseAbs().maxCoeff() < 1e-6); // six printed digits
}

TEST_CASE("the internal measures agree with the kernel's stress, and couple stress vanishes at rest", "[dem][periodic]")
{
  dem::Specimen           specimen(eight_spheres(), elastic(1.5), unit_links(0.2));
  dem::CellTestParameters p;
  base::Vector6           strain;
  strain << 1e-5, -2e-5, 0, 3e-5, 0, 1e-5;
  p.path = {strain_leg(50 * specimen.time_step(), strain)};
  dem::CellTest test(specimen, p);
  test.advance(50);
  specimen.advance(20);
  for (int rest = 0; rest < 2; ++rest)
    {
      const dem::CellState  cell  = specimen.cell();
      const auto            loads = specimen.links().load;
      const Eigen::Matrix3d sigma = dem::stress_of(dem::stress_moment(loads), cell.volume);
      REQUIRE((sigma - cell.stress).norm() < 1e-12 * cell.stress.norm());
      if (rest == 0)
        REQUIRE(relax(specimen, 1e-10) > 0);
      else
        {
          // At rest no particle feels a moment, so the stress is symmetric.
          REQUIRE((sigma - sigma.transpose()).norm() < 1e-9 * sigma.norm());
        }
    }
}

TEST_CASE("moving a particle by whole cells changes nothing", "[dem][periodic]")
{
  dem::Packing moved = eight_spheres();
  moved.centre[2] += Eigen::Vector3d(3, -2, 1);
  moved.centre[5] += Eigen::Vector3d(0, 0, -5);
  base::Vector6 stress[2];
  int           k = 0;
  for (const dem::Packing &packing : {eight_spheres(), moved})
    {
      dem::Specimen           specimen(packing, elastic(1.5), unit_links(0.2));
      dem::CellTestParameters p;
      base::Vector6           strain;
      strain << 0.01, -0.02, 0.005, 0.03, -0.01, 0.02;
      p.path = {strain_leg(300 * specimen.time_step(), strain)};
      dem::CellTest test(specimen, p);
      stress[k++] = test.advance(300).stress;
    }
  // Places are some six units off: round-off 1e-15 in branches of strain 0.01, and 300 steps of it.
  REQUIRE((stress[1] - stress[0]).norm() < 1e-10 * stress[0].norm());
}

TEST_CASE("two cells side by side answer like one, while links break and spheres meet", "[dem][periodic]")
{
  base::Vector6 stress[2];
  dem::Counts   counts[2];
  int           k = 0;
  for (const dem::Packing &packing : {disordered(4, 3), twice(disordered(4, 3))})
    {
      dem::Specimen           specimen(packing, concrete_specimen(), brittle_concrete());
      dem::CellTestParameters p;
      p.path = {strain_leg(400 * specimen.time_step(), 4e-3 * base::Vector6::Unit(0))};
      dem::CellTest test(specimen, p);
      stress[k]   = test.advance(400).stress;
      counts[k++] = specimen.counts();
    }
  REQUIRE(counts[0].broken > 20);
  REQUIRE(counts[0].contacts > 0);
  CHECK(counts[1].broken == 2 * counts[0].broken);
  CHECK(counts[1].contacts == 2 * counts[0].contacts);
  // Particles add up their links in another order; what is round-off at first, 1e-12, has grown to 1e-8 in a breaking body.
  CHECK((stress[1] - stress[0]).norm() < 1e-6 * stress[0].norm());
}

TEST_CASE("spheres meet across the boundary of the cell", "[dem][periodic]")
{
  // A bonded pair along x; its image is a gap of 0.1 away and meets it when the cell is 0.1 shorter.
  dem::Packing pair;
  pair.centre                        = {{0.5, 1, 1}, {2.5, 1, 1}};
  pair.radius                        = {1.0, 1.0};
  pair.periodic_cell                 = Eigen::Vector3d(4.1, 5, 5);
  dem::SpecimenParameters parameters = elastic(1.01);
  parameters.physics.contacts = parameters.physics.friction = true;
  dem::Specimen specimen(pair, parameters, unit_links(0.2));
  REQUIRE(specimen.counts().links == 1);

  dem::CellTestParameters p;
  const double            shorter = -0.2 / 4.1;
  p.path                          = {strain_leg(4000 * specimen.time_step(), shorter * base::Vector6::Unit(0))};
  dem::CellTest test(specimen, p);
  bool          met_late = false, apart_early = false;
  while (!test.finished())
    {
      const dem::CellSample s   = test.advance(20);
      const double          gap = 4.1 * specimen.cell().deformation(0, 0) -
                         (specimen.particles().position[1] - specimen.particles().position[0]).x() - 2;
      if (specimen.counts().contacts == 0)
        met_late = met_late || gap < -1e-3;
      else
        apart_early = apart_early || (specimen.counts().contacts == 1 && gap > 1e-3 && s.stress[0] < -1e-12);
    }
  CHECK_FALSE(met_late);
  CHECK_FALSE(apart_early);
  REQUIRE(specimen.counts().contacts == 1);
  REQUIRE(relax(specimen, 1e-9) > 0);
  // Two springs in series around the cell, both A E over their length: 2.0 bonded, and the contact's first distance below 2.0.
  const double stress = specimen.cell().stress(0, 0), area = M_PI;
  CHECK(stress * 25 == Approx(-area * 0.1 / 4.0).epsilon(0.01));
  CHECK(specimen.energy().balance_error() < 1e-3);
}

TEST_CASE("work on the cell is stored in a lattice, and its account closes", "[dem][periodic]")
{
  dem::SpecimenParameters parameters = elastic(1.1);
  parameters.damping                 = 0;
  const double            edge = 2 * std::sqrt(2.0), a = M_PI / (2 * std::sqrt(2.0));
  dem::Specimen           specimen(lattice({{0, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}, edge), parameters,
                                   unit_links(0.3));
  dem::CellTestParameters p;
  const double            strain = 1e-4;
  p.path                         = {strain_leg(100 * specimen.time_step(), strain * base::Vector6::Unit(3))};
  dem::CellTest test(specimen, p);
  test.advance(100);
  const dem::EnergyAccount e = specimen.energy();
  // 1/2 V D66 gamma^2; finite shear changes it by terms of the order of gamma^2 and, here, also gamma: 1e-4.
  CHECK(e.external_work == Approx(0.5 * edge * edge * edge * a / 2 * 1.3 * strain * strain).epsilon(3e-4));
  CHECK(e.kinetic < 1e-12 * e.elastic);
  CHECK(std::abs(e.residual()) < 1e-7 * e.elastic);
}

TEST_CASE("energy of a cell that is pulled apart and crushed stays accounted for", "[dem][periodic]")
{
  for (const double damping : {0.0, 0.3})
    {
      dem::SpecimenParameters parameters = concrete_specimen();
      parameters.damping                 = damping;
      parameters.step_factor             = 0.5;
      dem::Specimen           specimen(disordered(5, 11), parameters, brittle_concrete());
      dem::CellTestParameters p;
      const double            dt = specimen.time_step();
      base::Vector6           crushed;
      crushed << -0.05, 0.02, 0.02, 0.01, 0, 0.02;
      p.path = {strain_leg(1000 * dt, 3e-3 * base::Vector6::Unit(0)), strain_leg(2000 * dt, crushed)};
      dem::CellTest      test(specimen, p);
      dem::EnergyAccount before = specimen.energy();
      double             worst  = 0;
      while (!test.finished())
        {
          test.advance(100);
          const dem::EnergyAccount now = specimen.energy();
          worst                        = std::max(worst, now.balance_error());
          CHECK(now.damage >= before.damage);
          CHECK(now.damping >= before.damping);
          before = now;
        }
      REQUIRE(specimen.counts().broken > 50);
      REQUIRE(specimen.counts().contacts > 10);
      INFO("balance error " << worst << ", damping " << damping);
      CHECK(worst < 2e-3);
    }
}

TEST_CASE("a cell goes on from a saved state to the same bits, with any number of threads", "[dem][periodic]")
{
  const auto make = [] { return dem::Specimen(disordered(5, 2), concrete_specimen(), brittle_concrete()); };
  const auto path = [](const dem::Specimen &specimen) {
    dem::CellTestParameters p;
    const double            dt = specimen.time_step();
    dem::CellLeg            mixed;
    mixed.duration     = 200 * dt;
    mixed.stress_given = {{false, true, true, true, true, true}};
    mixed.target << 3e-3, 0, 0, 0, 0, 0;
    base::Vector6 crushed;
    crushed << -0.08, 0.03, 0.03, 0, 0, 0.02;
    p.path = {mixed, strain_leg(300 * dt, crushed)};
    return p;
  };
  const int   threads = omp_get_max_threads();
  MemoryState saved, whole, resumed;
  omp_set_num_threads(1);
  {
    dem::Specimen specimen = make();
    dem::CellTest test(specimen, path(specimen));
    test.advance(150), test.advance(270);
    saved = MemoryState::of(specimen, test);
    test.advance(50), test.advance(30);
    REQUIRE(specimen.counts().contacts > 0);
    REQUIRE(specimen.counts().broken > 0);
    whole = MemoryState::of(specimen, test);
  }
  omp_set_num_threads(2);
  {
    dem::Specimen specimen = make();
    dem::CellTest test(specimen, path(specimen));
    saved.restore(specimen, test);
    test.advance(50), test.advance(30);
    resumed = MemoryState::of(specimen, test);
  }
  omp_set_num_threads(threads);
  REQUIRE(resumed == whole);
}

TEST_CASE("what a periodic specimen cannot do is refused by name", "[dem][periodic]")
{
  dem::Packing free = eight_spheres();
  free.periodic_cell.reset();
  REQUIRE_THROWS_WITH(dem::Specimen(free, elastic(1.5), unit_links(0.2)), Contains("no periodic cell"));

  dem::SpecimenParameters body = elastic(1.5);
  body.physics.periodic        = false;
  dem::Specimen unbounded(free, body, unit_links(0.2));
  REQUIRE_THROWS_WITH(unbounded.set_velocity_gradient(Eigen::Matrix3d::Zero()), Contains("no periodic cell"));
  REQUIRE_THROWS_AS(unbounded.cell(), base::InputError);

  dem::Specimen cell(eight_spheres(), elastic(1.5), unit_links(0.2));
  REQUIRE_THROWS_WITH(cell.grips().add({}), Contains("periodic cell"));
  REQUIRE_THROWS_WITH(cell.set_velocity_gradient(Eigen::Matrix3d::Constant(std::nan(""))), Contains("finite"));
  cell.set_velocity_gradient(-2 / cell.time_step() * Eigen::Matrix3d(Eigen::Vector3d(1, 0, 0).asDiagonal()));
  REQUIRE_THROWS_AS(cell.advance(1), base::NumericalError);

  dem::Specimen plane(six_discs(), elastic(1.25, 2), unit_links(0.2));
  REQUIRE_THROWS_WITH(plane.set_velocity_gradient(Eigen::Matrix3d::Identity()), Contains("along z"));
}
