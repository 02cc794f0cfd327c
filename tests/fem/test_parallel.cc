// Run with mpirun: the answer on all ranks together against the answer of one rank alone.
#include "tests/fem/concrete_fixture.h"
#include "tests/fem/solid_fixture.h"

using namespace dealii;
using fem::ElementFamily;

namespace
{
  const auto zero = [](const Point<3> &, double) { return 0.0; };

  fem::Loads<3> twist()
  {
    fem::Loads<3> loads;
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back({"0", c, zero});
    loads.tractions.push_back({"1", [](const Point<3> &x, double t) {
                                 return t * Tensor<1, 3>({1e5, 1e5 * x[2], -2e5 * x[1]});
                               }});
    loads.point_forces.push_back({Point<3>(1.3, 0.5, 0.6), [](double t) { return Tensor<1, 3>({0, 0, 3e4 * t}); }});
    return loads;
  }
}

TEST_CASE("ranks: elastic displacement and reaction equal the serial ones", "[fem][mpi]")
{
  const auto family = ElementFamily::hypercube;
  for (const auto method : {fem::LinearMethod::automatic, fem::LinearMethod::iterative})
    {
      fem::LinearSolverOptions linear;
      linear.method    = method;
      linear.tolerance = 1e-12;
      const auto build = [](Triangulation<3> &mesh) {
        box<3>({2, 1, 1}, {4, 2, 2})(mesh);
        // A bend that is the same on every rank (a random distortion is not).
        GridTools::transform(
          [](const Point<3> &x) { return Point<3>(x[0], x[1] + 0.05 * std::sin(2 * x[0]), x[2] - 0.04 * x[0] * x[1]); },
          mesh);
      };
      Model<3> one(build, family, {}, elastic(1e9, 0.2), twist(), {}, MPI_COMM_SELF);
      Model<3> all(build, family, {}, elastic(1e9, 0.2), twist(), {}, MPI_COMM_WORLD, linear);
      REQUIRE(one.solver->advance_to(1).converged);
      REQUIRE(all.solver->advance_to(1).converged);
      INFO(all.solver->linear_solver());
      for (const Point<3> &place : {Point<3>(1.9, 0.5, 0.5), Point<3>(1.2, 0.3, 0.6), Point<3>(0.5, 0.5, 0.1)})
        for (unsigned int c = 0; c < 3; ++c)
          CHECK(all.at(place, c) == Approx(one.at(place, c)).epsilon(1e-8).margin(1e-12));
      for (unsigned int c = 0; c < 3; ++c)
        CHECK(all.solver->reaction("0")[c] == Approx(one.solver->reaction("0")[c]).epsilon(1e-8).margin(1e-3));
      CHECK(all.solver->energy().external == Approx(one.solver->energy().external).epsilon(1e-8));
    }
}

TEST_CASE("ranks: simplices are refused on several ranks, with the way out", "[fem][mpi]")
{
  const auto make = [] { fem::make_mesh<3>(box<3>({1, 1, 1}, {1, 1, 1}), ElementFamily::simplex, MPI_COMM_WORLD); };
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    CHECK_THROWS_WITH(make(), Catch::Contains("one rank only"));
  else
    CHECK_NOTHROW(make());
}

TEST_CASE("ranks: concrete that yields answers as in serial", "[fem][mpi]")
{
  auto               p = material_m1();
  fem::NewtonOptions newton;
  newton.tolerance = 1e-11;
  fem::Loads<3> loads;
  for (unsigned int c = 0; c < 3; ++c)
    {
      loads.displacements.push_back({"0", c, zero});
      loads.displacements.push_back(
        {"1", c, [c](const Point<3> &x, double t) { return -1e-3 * t * (c == 0 ? 1 + x[1] : 0.2); }});
    }
  Model<3> one(box<3>({1, 1, 1}, {3, 2, 2}), ElementFamily::hypercube, {}, fem::DamagePlasticConcrete(p), loads, newton,
               MPI_COMM_SELF);
  Model<3> all(box<3>({1, 1, 1}, {3, 2, 2}), ElementFamily::hypercube, {}, fem::DamagePlasticConcrete(p), loads, newton,
               MPI_COMM_WORLD);
  for (int step = 1; step <= 3; ++step)
    {
      REQUIRE(one.solver->advance_to(step / 3.0).converged);
      REQUIRE(all.solver->advance_to(step / 3.0).converged);
    }
  CHECK(one.solver->energy().internal > 0);
  for (unsigned int c = 0; c < 3; ++c)
    CHECK(all.solver->reaction("1")[c] == Approx(one.solver->reaction("1")[c]).epsilon(1e-7));
  CHECK(all.at({0.5, 0.5, 0.5}, 1) == Approx(one.at({0.5, 0.5, 0.5}, 1)).epsilon(1e-6));
}
