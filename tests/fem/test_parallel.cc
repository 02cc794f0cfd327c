// Run with mpirun: the answer on all ranks together against the answer of one rank alone.
#include "fem/explicit/explicit_solver.h"
#include "fem/references/concrete_points.h"
#include "tests/fem/solid_fixture.h"

using namespace fem::references;

using namespace dealii;
using fem::ElementFamily;

namespace
{
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

namespace
{
  /// The answer of all ranks by one method against the direct one of a single rank.
  void compare_with_serial(const ElementFamily family, const unsigned int degree, const fem::LinearMethod method)
  {
    fem::LinearSolverOptions linear;
    linear.method    = method;
    linear.tolerance = 1e-12;
    const auto build = [family](Triangulation<3> &mesh) {
      const unsigned int n = family == ElementFamily::hypercube ? 2 : 1;
      box<3>({2, 1, 1}, {2 * n, n, n})(mesh);
      // A bend that is the same on every rank (a random distortion is not).
      GridTools::transform(
        [](const Point<3> &x) { return Point<3>(x[0], x[1] + 0.05 * std::sin(2 * x[0]), x[2] - 0.04 * x[0] * x[1]); },
        mesh);
      if (family == ElementFamily::hypercube)
        mesh.refine_global(1);
    };
    fem::SolidOptions options;
    options.degree = degree;
    Model<3> one(build, family, options, elastic(1e9, 0.2), twist(), {}, MPI_COMM_SELF);
    Model<3> all(build, family, options, elastic(1e9, 0.2), twist(), {}, MPI_COMM_WORLD, linear);
    REQUIRE(one.solver->advance_to(1).converged);
    REQUIRE(all.solver->advance_to(1).converged);
    INFO(all.solver->linear_solver());
    for (const Point<3> &place : {Point<3>(1.9, 0.5, 0.4), Point<3>(1.2, 0.3, 0.6), Point<3>(0.5, 0.5, 0.1)})
      for (unsigned int c = 0; c < 3; ++c)
        CHECK(all.at(place, c) == Approx(one.at(place, c)).epsilon(1e-8).margin(1e-12));
    for (unsigned int c = 0; c < 3; ++c)
      CHECK(all.solver->reaction("0")[c] == Approx(one.solver->reaction("0")[c]).epsilon(1e-8).margin(1e-3));
    CHECK(all.solver->energy().external == Approx(one.solver->energy().external).epsilon(1e-8));
  }
}

TEST_CASE("ranks: elastic displacement and reaction equal the serial ones, by every solver", "[fem][mpi]")
{
  for (const unsigned int degree : {1u, 2u})
    {
      for (const auto method : {fem::LinearMethod::direct, fem::LinearMethod::iterative, fem::LinearMethod::geometric})
        compare_with_serial(ElementFamily::hypercube, degree, method);
      for (const auto method : {fem::LinearMethod::direct, fem::LinearMethod::iterative})
        compare_with_serial(ElementFamily::simplex, degree, method);
    }
}

TEST_CASE("ranks: motion of hexahedra and of tetrahedra equals the serial one", "[fem][mpi]")
{
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    {
      std::vector<Tensor<1, 3>> ends;
      for (const MPI_Comm comm : {MPI_COMM_SELF, MPI_COMM_WORLD})
        {
          Model<3>             model(box<3>({2, 1, 1}, {4, 2, 2}), family, {}, elastic(1e9, 0.2), twist(), {}, comm);
          fem::ExplicitOptions options;
          options.density = {{"0", 2000.0}};
          options.damping = 50;
          fem::ExplicitSolver<3> motion(model.solid, options);
          for (int step = 0; step < 40; ++step)
            motion.advance(motion.step());
          Tensor<1, 3> end;
          for (unsigned int c = 0; c < 3; ++c)
            {
              for (const auto &[dof, weight] : model.solid.interpolation({1.7, 0.6, 0.4}, c))
                end[c] += weight * motion.displacement()[dof];
              end[c] = Utilities::MPI::sum(end[c], comm);
            }
          CHECK(std::fabs(motion.energy().balance()) < 1e-10);
          ends.push_back(end);
        }
      CHECK(ends[0].norm() > 0);
      CHECK((ends[1] - ends[0]).norm() <= 1e-11 * ends[0].norm());
    }
}

TEST_CASE("ranks: concrete restored in the middle of a run goes on to the same last bit", "[fem][mpi]")
{
  fem::Loads<3> loads;
  for (unsigned int c = 0; c < 3; ++c)
    {
      loads.displacements.push_back({"0", c, zero});
      loads.displacements.push_back(
        {"1", c, [c](const Point<3> &x, double t) { return -2e-4 * t * (c == 0 ? 1 + x[1] : 0.2); }});
    }
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    {
      const auto make = [&] {
        return std::make_unique<Model<3>>(box<3>({1, 1, 1}, {2, 1, 1}), family, fem::SolidOptions(),
                                          fem::DamagePlasticConcrete(material_m1()), loads, fem::NewtonOptions(),
                                          MPI_COMM_WORLD);
      };
      auto straight = make(), resumed = make();
      for (int step = 1; step <= 2; ++step)
        {
          const auto report = straight->solver->advance_to(step);
          INFO(report.reason << " by " << straight->solver->linear_solver());
          REQUIRE(report.converged);
        }
      std::vector<double> history;
      straight->solid.visit_histories([&](const fem::PointQuantity &of, const double *values) {
        history.insert(history.end(), values, values + of.values());
      });
      std::size_t next = 0;
      resumed->solid.visit_histories([&](const fem::PointQuantity &of, double *values) {
        for (int i = 0; i < of.values(); ++i)
          values[i] = history[next++];
      });
      resumed->solver->restore(straight->solver->state());
      REQUIRE(straight->solver->advance_to(3).converged);
      REQUIRE(resumed->solver->advance_to(3).converged);
      CHECK(resumed->solver->energy().internal == straight->solver->energy().internal);
      fem::Vector difference = resumed->solver->displacement();
      difference -= straight->solver->displacement();
      CHECK(difference.linfty_norm() == 0);
    }
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

TEST_CASE("ranks: concrete that cracks, driven by opening and by arc length follows the serial path", "[fem][mpi]")
{
  // A plate bent by its right side turning, in plane stress: cracks from the top.
  fem::Loads<2> loads;
  for (unsigned int c = 0; c < 2; ++c)
    loads.displacements.push_back({"0", c, [](const Point<2> &, double) { return 0.0; }});
  loads.displacements.push_back({"1", 0, [](const Point<2> &x, double t) { return t * x[1]; }});
  fem::SolidOptions options;
  options.plane        = fem::Plane::stress;
  auto ductile         = material_m1();
  ductile.element_size = 0.1;
  fem::NewtonOptions newton;
  newton.tolerance = 1e-11;
  for (const auto method : {fem::LinearMethod::direct, fem::LinearMethod::iterative})
    for (const auto kind : {fem::PathControl::Kind::indirect, fem::PathControl::Kind::cylindrical})
      {
        fem::LinearSolverOptions linear;
        linear.method       = method;
        linear.tolerance    = 1e-12;
        const auto to_crack = [&](const MPI_Comm comm) {
          Model<2>         model(box<2>({0.2, 0.1}, {8, 4}), ElementFamily::hypercube, options,
                                 fem::DamagePlasticConcrete(ductile), loads, newton, comm, linear);
          fem::PathControl path;
          path.kind = kind;
          if (kind == fem::PathControl::Kind::indirect)
            path.weights = model.solid.interpolation({0.05, 0.1}, 0);
          std::vector<double> curve;
          for (int step = 0; step < 8; ++step)
            {
              const auto report = model.solver->advance_along(path, kind == path.Kind::indirect ? 1e-6 : 1.4e-5);
              INFO("step " << step << ": " << report.reason << " by " << model.solver->linear_solver());
              REQUIRE(report.converged);
              curve.push_back(model.solver->time());
              curve.push_back(model.solver->energy().internal);
            }
          return curve;
        };
        const std::vector<double> one = to_crack(MPI_COMM_SELF), all = to_crack(MPI_COMM_WORLD);
        // Cracked: less work than an elastic plate would take to the same turn.
        CHECK(one[15] < 0.98 * one[1] * std::pow(one[14] / one[0], 2));
        for (std::size_t i = 0; i < one.size(); ++i)
          CHECK(all[i] == Approx(one[i]).epsilon(1e-7));
      }
}
