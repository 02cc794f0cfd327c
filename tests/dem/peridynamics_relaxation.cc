#include "base/flat_state.h"
#include "dem/peridynamics/fictitious_density.h"
#include "dem/peridynamics/relaxation.h"
#include "peridynamics_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace peridynamic_tests;

namespace
{
  double apart(const Grid &grid, Field a, const Field &b)
  {
    remove_rigid_motion(grid, a);
    double most = 0, difference = 0;
    for (const std::size_t i : grid.nodes())
      {
        most       = std::max(most, b.at(i).norm());
        difference = std::max(difference, (a.at(i) - b.at(i)).norm());
      }
    return difference / most;
  }

  /** Steps until it is at rest. */
  std::int64_t relax(Relaxation &relaxation, const Bonds &bonds, const Loads &loads, const double tolerance)
  {
    relaxation.load(loads, 1.0);
    while (!relaxation.at_rest(tolerance) && relaxation.steps() < 20000)
      relaxation.step(bonds, loads);
    return relaxation.steps();
  }

  Case block()
  {
    Case c       = plate(10, Layout::cell_centred);
    c.body.space = Space::space;
    c.body.size  = {1.0, 0.5, 0.5};
    c.pulls      = {uniform("left", {-q, 0, 0}), uniform("right", {q, 0, 0})};
    return c;
  }
} // namespace

TEST_CASE("a relaxed state is the direct solution to 1e-8", "[dem]")
{
  const Case line = rod(50, 3, BondModel::prototype, Layout::boundary_nodes, Volumes::partial);
  for (const Case &c :
       {line, pulled_plate(50, Layout::cell_centred), pulled_plate(50, Layout::boundary_nodes), block()})
    for (const FictitiousDensity density : {FictitiousDensity::gershgorin, FictitiousDensity::constant})
      {
        const Bonds bonds = c.bonds();
        Relaxation  relaxation(bonds, Kinematics::linear, density);
        relax(relaxation, bonds, c.loads(bonds), 1e-10);
        CHECK(apart(bonds.grid(), relaxation.displacement(), displacement(c, bonds)) < 1e-8);
      }
}

TEST_CASE("a relaxed state of nonlinear kinematics is Newton's to 1e-8", "[dem]")
{
  Case c            = pulled_plate(50, Layout::cell_centred);
  c.pulls           = {uniform("bottom", {0, -50 * q, 0}), uniform("top", {0, 50 * q, 0})}; // strains of some per cent
  const Bonds bonds = c.bonds();
  Relaxation  relaxation(bonds, Kinematics::nonlinear, FictitiousDensity::gershgorin);
  relax(relaxation, bonds, c.loads(bonds), 1e-10);
  CHECK(apart(bonds.grid(), relaxation.displacement(), displacement(c, bonds, Solver::direct, Kinematics::nonlinear)) <
        1e-8);
}

TEST_CASE("one node on a spring relaxes to force over stiffness", "[dem]")
{
  Case c            = rod(2, 1.0, BondModel::prototype, Layout::cell_centred, Volumes::full);
  c.pulls           = {uniform("right", {q, 0, 0})};
  const Bonds bonds = c.bonds();
  Loads       loads = c.loads(bonds);
  loads.held[0]     = 1;
  Relaxation relaxation(bonds, Kinematics::linear, FictitiousDensity::gershgorin);
  relaxation.load(loads, 1.0);
  for (int n = 0; n < 200; ++n)
    relaxation.step(bonds, loads);
  const double stiffness = bonds.stiffness()[0] / 0.5;
  Field        forces    = bonds.grid().field();
  loads.forces(1.0, nullptr, forces);
  CHECK(relaxation.displacement().c[0][1] == Approx(forces.c[0][1] / stiffness).epsilon(1e-12));
}

TEST_CASE("a relaxation that goes on from its state takes the same steps to the last bit, with any number of threads",
          "[dem]")
{
  const Case  c     = pulled_plate(50, Layout::cell_centred);
  const Bonds bonds = c.bonds();
  const Loads loads = c.loads(bonds);
  Relaxation  whole(bonds, Kinematics::nonlinear, FictitiousDensity::gershgorin), later = whole;
  whole.load(loads, 1.0);
  const int    threads = omp_get_max_threads();
  base::Column row;
  for (int n = 0; n < 100; ++n)
    {
      if (n == 40)
        {
          base::FlatStateWriter writer(row);
          whole.visit_state(writer);
        }
      whole.step(bonds, loads);
    }
  base::FlatStateReader reader(row);
  later.visit_state(reader);
  omp_set_num_threads(3);
  for (int n = 40; n < 100; ++n)
    later.step(bonds, loads);
  omp_set_num_threads(threads);
  CHECK(later.steps() == 100);
  CHECK(whole.displacement().c == later.displacement().c);
}

TEST_CASE("relaxations take as many steps as published", "[dem]")
{
  // peridynamics.md of the source documents, 7.5, B1: residuals below 1e-3 and 1e-6.
  const Case  c     = pulled_plate(100, Layout::cell_centred);
  const Bonds bonds = c.bonds();
  const Loads loads = c.loads(bonds);
  for (const FictitiousDensity density : {FictitiousDensity::gershgorin, FictitiousDensity::constant})
    {
      const bool gershgorin = density == FictitiousDensity::gershgorin;
      Relaxation relaxation(bonds, Kinematics::linear, density);
      relaxation.load(loads, 1.0);
      std::int64_t coarse = 0;
      while (relaxation.residual() > 1e-6 && relaxation.steps() < 3000)
        {
          relaxation.step(bonds, loads);
          if (coarse == 0 && relaxation.residual() < 1e-3)
            coarse = relaxation.steps();
        }
      CHECK(static_cast<double>(coarse) == Approx(gershgorin ? 168 : 500).epsilon(0.05));
      CHECK(static_cast<double>(relaxation.steps()) == Approx(gershgorin ? 328 : 914).epsilon(0.05));
    }
}

TEST_CASE("Gershgorin's bound is that of the assembled rows, and does not grow when bonds break", "[dem]")
{
  Case c                    = plate(6, Layout::cell_centred);
  c.body.size               = {1.0, 1.0, 0.0};
  Bonds       bonds         = c.bonds();
  const Grid &grid          = bonds.grid();
  const auto  rows_of_nodes = [&] {
    std::vector<double> most;
    const auto          n = static_cast<Eigen::Index>(grid.nodes().size());
    Eigen::MatrixXd     K = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    BondForces          forces(bonds, Kinematics::linear);
    for (Eigen::Index column = 0; column < 2 * n; ++column)
      {
        Field u = grid.field(), f = u;
        u.c[static_cast<std::size_t>(column % 2)][grid.nodes()[static_cast<std::size_t>(column / 2)]] = 1;
        forces.add_up(bonds, u, f);
        for (Eigen::Index row = 0; row < 2 * n; ++row)
          K(row, column) = -f.c[static_cast<std::size_t>(row % 2)][grid.nodes()[static_cast<std::size_t>(row / 2)]];
      }
    const Eigen::VectorXd sums = K.cwiseAbs().rowwise().sum();
    for (Eigen::Index i = 0; i < n; ++i)
      most.push_back(std::max(sums[2 * i], sums[2 * i + 1]) / grid.volume()[grid.nodes()[static_cast<std::size_t>(i)]]);
    return most;
  };
  base::Column before;
  for (int round = 0; round < 3; ++round)
    {
      const base::Column        bound = bound_of_stiffness(bonds);
      const std::vector<double> rows  = rows_of_nodes();
      for (std::size_t n = 0; n < rows.size(); ++n)
        CHECK(bound[grid.nodes()[n]] == Approx(rows[n]).epsilon(1e-12));
      for (std::size_t i = 0; i < before.size(); ++i)
        CHECK(bound[i] <= before[i] * (1 + 1e-12));
      before = bound;
      bonds.cut({{-0.3, -0.4 + 0.2 * round, 0}, {0.2, 0.3, 0}, Eigen::Vector3d::Zero()});
    }
}
