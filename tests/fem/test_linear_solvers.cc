// The linear solvers against each other, and what is said where one does not fit.
#include "fem/materials/anisotropic_elastic.h"
#include "tests/fem/solid_fixture.h"

using namespace dealii;
using fem::ElementFamily;
using fem::LinearMethod;

namespace
{
  /// Clamped at x = 0 but for a lift of its end, pulled and pressed elsewhere.
  template <int dim>
  fem::Loads<dim> mixed_loads()
  {
    fem::Loads<dim> loads;
    for (unsigned int c = 0; c < dim; ++c)
      loads.displacements.push_back({"0", c, [](const Point<dim> &, double) { return 0.0; }});
    loads.displacements.push_back({"1", 1, [](const Point<dim> &, double t) { return 1e-3 * t; }});
    loads.pressures.push_back({"3", [](const Point<dim> &, double t) { return 2e5 * t; }});
    loads.body_force = [](const Point<dim> &x, double t) {
      Tensor<1, dim> force;
      force[0] = 1e5 * t * x[1];
      return force;
    };
    return loads;
  }

  /// Hexahedra that no grid of boxes makes: a distorted coarse mesh, refined.
  fem::BuildMesh<3> irregular(const unsigned int refinements)
  {
    return [=](Triangulation<3> &mesh) {
      box<3>({2, 1, 1}, {3, 2, 2}, 0.15)(mesh);
      mesh.refine_global(refinements);
    };
  }

  fem::LinearSolverOptions by(const LinearMethod method)
  {
    fem::LinearSolverOptions linear;
    linear.method    = method;
    linear.tolerance = 1e-12;
    return linear;
  }

  template <int dim, typename Law>
  void same_answer(const fem::BuildMesh<dim> &build, const fem::SolidOptions &options, const Law &law)
  {
    Model<dim> direct(build, ElementFamily::hypercube, options, law, mixed_loads<dim>(), {}, MPI_COMM_SELF,
                      by(LinearMethod::direct));
    for (const auto method : {LinearMethod::iterative, LinearMethod::geometric})
      {
        Model<dim> other(build, ElementFamily::hypercube, options, law, mixed_loads<dim>(), {}, MPI_COMM_SELF,
                         by(method));
        for (const double time : {1.0, 3.0}) // the second step starts from a deformed state
          {
            REQUIRE(direct.solver->advance_to(time).converged);
            REQUIRE(other.solver->advance_to(time).converged);
            fem::Vector difference = other.solver->displacement();
            difference -= direct.solver->displacement();
            INFO(other.solver->linear_solver());
            CHECK(difference.linfty_norm() <= 1e-9 * direct.solver->displacement().linfty_norm());
            CHECK(other.solver->energy().external == Approx(direct.solver->energy().external).epsilon(1e-9));
          }
        direct.solver->restore(fem::StaticState{
          0, 0, {}, direct.solid.make_vector(), direct.solid.make_vector(), direct.solid.make_vector()});
      }
  }

  fem::AnisotropicElastic anisotropic()
  {
    base::Stiffness full = base::Stiffness::Identity() * 20e9;
    for (int i = 0; i < 6; ++i)
      for (int j = i + 1; j < 6; ++j)
        full(i, j) = full(j, i) = 1e9 * std::cos(i + 3.0 * j);
    return fem::AnisotropicElastic(full);
  }
}

TEST_CASE("geometric and algebraic multigrid give the displacement of the direct solver", "[fem]")
{
  fem::SolidOptions linear, quadratic;
  quadratic.degree    = 2;
  linear.thickness    = 0.3;
  quadratic.thickness = 0.3;
  same_answer<3>(irregular(2), linear, elastic(30e9, 0.2));
  same_answer<3>(irregular(1), linear, anisotropic());
  same_answer<3>(irregular(1), quadratic, elastic(30e9, 0.2));
  const fem::BuildMesh<2> plate = [](Triangulation<2> &mesh) {
    box<2>({2, 1}, {4, 2})(mesh);
    mesh.refine_global(3);
  };
  same_answer<2>(plate, linear, elastic(30e9, 0.3));
  same_answer<2>(plate, quadratic, elastic(30e9, 0.3));
}

TEST_CASE("geometric multigrid: iterations do not grow with the mesh, and a stiff inclusion is solved", "[fem]")
{
  unsigned int iterations[3];
  for (unsigned int refinements = 1; refinements <= 3; ++refinements)
    {
      Model<3> model(irregular(refinements), ElementFamily::hypercube, {}, elastic(30e9, 0.2), mixed_loads<3>(), {},
                     MPI_COMM_SELF, by(LinearMethod::geometric));
      REQUIRE(model.solver->advance_to(1).converged);
      iterations[refinements - 1] = model.solver->linear_iterations();
    }
  INFO(iterations[0] << " " << iterations[1] << " " << iterations[2]);
  CHECK(iterations[2] <= iterations[0] + 6);
  CHECK(iterations[2] <= 25);

  const auto two_materials = [](Triangulation<3> &mesh) {
    box<3>({2, 1, 1}, {3, 2, 2})(mesh);
    mesh.refine_global(2);
    for (const auto &cell : mesh.active_cell_iterators()) // not aligned with the coarse elements
      cell->set_material_id(cell->center().distance(Point<3>(1, 0.5, 0.5)) < 0.35 ? 1 : 0);
  };
  fem::Vector answers[2];
  int         i = 0;
  for (const auto method : {LinearMethod::direct, LinearMethod::geometric})
    {
      fem::Solid<3> solid(fem::make_mesh<3>(two_materials, ElementFamily::hypercube, MPI_COMM_SELF), {});
      solid.assign("0", fem::make_points(elastic(1e9, 0.2), fem::Plane::strain));
      solid.assign("1", fem::make_points(elastic(100e9, 0.2), fem::Plane::strain));
      solid.set_loads(mixed_loads<3>());
      fem::StaticSolver<3> solver(solid, {}, by(method));
      REQUIRE(solver.advance_to(1).converged);
      answers[i++] = solver.displacement();
    }
  const double size = answers[0].linfty_norm();
  answers[0] -= answers[1];
  CHECK(answers[0].linfty_norm() <= 1e-8 * size);
}

TEST_CASE("algebraic multigrid has the rotations of a body: a slender beam takes few iterations", "[fem]")
{
  fem::SolidOptions quadratic;
  quadratic.degree         = 2;
  const auto iterations_of = [&](const double length) {
    const auto build = [=](Triangulation<3> &mesh) {
      box<3>({length, 1, 1}, {static_cast<unsigned int>(2 * length), 2, 2})(mesh);
      mesh.refine_global(1);
    };
    Model<3> model(build, ElementFamily::hypercube, quadratic, elastic(30e9, 0.2), mixed_loads<3>(), {}, MPI_COMM_SELF,
                   by(LinearMethod::iterative));
    REQUIRE(model.solver->advance_to(1).converged);
    return model.solver->linear_iterations();
  };
  const unsigned int slender = iterations_of(10);
  INFO(slender);
  CHECK(slender <= 40); // 28; 81 where translations alone are given
}

TEST_CASE("large elastic problems choose geometric multigrid where it fits, and say why where not", "[fem]")
{
  fem::LinearSolverOptions large;
  large.direct_limit    = 100; // so that small test problems count as large
  const auto said_about = [&](const fem::BuildMesh<3> &build, const ElementFamily family,
                              const fem::SolidOptions &options, const fem::Loads<3> &loads) {
    Model<3> model(build, family, options, elastic(1e9, 0.2), loads, {}, MPI_COMM_SELF, large);
    REQUIRE(model.solver->advance_to(1).converged);
    return model.solver->linear_solver();
  };
  const auto hypercube = ElementFamily::hypercube;
  CHECK_THAT(said_about(irregular(1), hypercube, {}, mixed_loads<3>()),
             Catch::Contains("geometric multigrid of 2 levels") && Catch::Contains("more than 100"));
  CHECK_THAT(said_about(irregular(0), hypercube, {}, mixed_loads<3>()),
             Catch::Contains("algebraic multigrid") && Catch::Contains("not a refinement of a coarser one"));
  fem::SolidOptions mean;
  mean.mean_dilatation = true;
  CHECK_THAT(said_about(irregular(1), hypercube, mean, mixed_loads<3>()), Catch::Contains("with mean dilatation"));
  CHECK_THAT(said_about(box<3>({2, 1, 1}, {4, 2, 2}), ElementFamily::simplex, {}, mixed_loads<3>()),
             Catch::Contains("tetrahedra have no refinement levels"));
  // Supports at nodes that only the finest level has.
  fem::Loads<3> nodes;
  nodes.pressures.push_back({"0", [](const Point<3> &, double t) { return 1e5 * t; }});
  nodes.pressures.push_back({"1", [](const Point<3> &, double t) { return 1e5 * t; }});
  for (unsigned int c = 0; c < 3; ++c)
    nodes.nodes.push_back({Point<3>(0.25, 0.25, 0.25), c, zero});
  nodes.nodes.push_back({Point<3>(0.75, 0.25, 0.25), 1, zero});
  nodes.nodes.push_back({Point<3>(0.75, 0.25, 0.25), 2, zero});
  nodes.nodes.push_back({Point<3>(0.25, 0.75, 0.25), 2, zero});
  const auto cube = [](Triangulation<3> &mesh) {
    box<3>({1, 1, 1}, {2, 2, 2})(mesh);
    mesh.refine_global(1);
  };
  CHECK_THAT(said_about(cube, hypercube, {}, nodes), Catch::Contains("the supports do not hold its coarsest level"));

  CHECK_THROWS_WITH((Model<3>(irregular(0), hypercube, {}, elastic(1e9, 0.2), mixed_loads<3>(), {}, MPI_COMM_SELF,
                              by(LinearMethod::geometric))),
                    Catch::Contains("linear solver = geometric: the mesh is not a refinement"));
}
