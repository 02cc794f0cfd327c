#include "apps/bench/continuum_cases.h"

#include "apps/bench/results.h"
#include "base/stopwatch.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/mesh/shapes.h"
#include "fem/solvers/static_solver.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>

namespace apps
{
  using namespace dealii;

  namespace
  {
    constexpr double young = 30e9, poisson = 0.2, pi = numbers::PI;

    double bump(const Point<3> &x) { return std::sin(pi * x[0]) * std::sin(pi * x[1]) * std::sin(pi * x[2]); }

    class Exact : public Function<3>
    {
    public:
      Exact()
        : Function<3>(3)
      {
      }
      double value(const Point<3> &x, const unsigned int c) const override { return c == 0 ? bump(x) : 0.0; }
    };

    /** -div sigma of the displacement above, by hand from lambda grad div u + mu (laplace u + grad div u). */
    Tensor<1, 3> body_force(const Point<3> &x)
    {
      const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
      const double sx = std::sin(pi * x[0]), sy = std::sin(pi * x[1]), sz = std::sin(pi * x[2]);
      const double cx = std::cos(pi * x[0]), cy = std::cos(pi * x[1]), cz = std::cos(pi * x[2]);
      const Tensor<1, 3> grad_div({-pi * pi * sx * sy * sz, pi * pi * cx * cy * sz, pi * pi * cx * sy * cz});
      return -(lambda + mu) * grad_div + Tensor<1, 3>({3 * pi * pi * mu * bump(x), 0, 0});
    }

    double relative_error(const fem::Solid<3> &solid, const fem::Vector &displacement)
    {
      const unsigned int  k = solid.options().degree;
      const Quadrature<3> q = solid.mesh().family == fem::ElementFamily::hypercube ?
                                Quadrature<3>(QGauss<3>(k + 2)) :
                                Quadrature<3>(QGaussSimplex<3>(k + 2));
      Vector<double>      cells(solid.mesh().triangulation->n_active_cells());
      VectorTools::integrate_difference(solid.mapping(), solid.dofs(), displacement, Exact(), cells, q,
                                        VectorTools::L2_norm);
      return cells.l2_norm() / std::sqrt(1.0 / 8); // the mean square of the bump over the cube is 1/8
    }
  } // namespace

  std::string ContinuumCase::element_name() const
  {
    return (family == fem::ElementFamily::hypercube ? "Q" : "P") + std::to_string(degree);
  }

  std::string ContinuumCase::solver_name() const
  {
    return method == fem::LinearMethod::direct    ? "direct" :
           method == fem::LinearMethod::iterative ? "algebraic multigrid" :
                                                    "geometric multigrid";
  }

  std::vector<ContinuumCase> continuum_cases(const bool quick)
  {
    using fem::ElementFamily;
    using fem::LinearMethod;
    std::vector<ContinuumCase> cases;
    const auto add = [&](const ElementFamily family, const unsigned int degree, const LinearMethod method,
                         const unsigned int largest) {
      for (unsigned int n = family == ElementFamily::hypercube ? 4 : 2; n <= largest; n *= 2)
        cases.push_back({family, degree, n, method});
    };
    const auto cube = ElementFamily::hypercube, simplex = ElementFamily::simplex;
    add(cube, 1, LinearMethod::direct, quick ? 8 : 16);
    add(cube, 1, LinearMethod::iterative, quick ? 8 : 32);
    add(cube, 1, LinearMethod::geometric, quick ? 16 : 64);
    add(cube, 2, LinearMethod::direct, quick ? 4 : 8);
    add(cube, 2, LinearMethod::iterative, quick ? 4 : 16);
    add(cube, 2, LinearMethod::geometric, quick ? 8 : 32);
    add(simplex, 1, LinearMethod::direct, quick ? 4 : 8);
    add(simplex, 1, LinearMethod::iterative, quick ? 4 : 16);
    add(simplex, 2, LinearMethod::direct, quick ? 2 : 4);
    add(simplex, 2, LinearMethod::iterative, quick ? 4 : 8);
    return cases;
  }

  fem::Mesh<3> unit_cube(const fem::ElementFamily family, const unsigned int divisions, const MPI_Comm communicator)
  {
    fem::BoxShape box;
    box.divisions = {divisions, divisions, divisions};
    fem::ShapeOptions options;
    options.family       = family;
    options.communicator = communicator;
    return fem::make_shape<3>(box, options);
  }

  ContinuumError solve_case(const ContinuumCase &which)
  {
    const double      start = base::processor_seconds();
    fem::SolidOptions options;
    options.degree = which.degree;
    fem::Solid<3>                   solid(unit_cube(which.family, which.divisions, MPI_COMM_SELF), options);
    fem::IsotropicElasticParameters law;
    law.young_modulus = young;
    law.poisson_ratio = poisson;
    solid.assign("solid", fem::make_points(fem::IsotropicElastic(law), fem::Plane::strain));
    fem::Loads<3> loads;
    for (const auto &boundary : solid.mesh().boundaries)
      for (unsigned int c = 0; c < 3; ++c)
        loads.displacements.push_back({boundary.first, c, [](const Point<3> &, double) { return 0.0; }});
    loads.body_force = [](const Point<3> &x, double) { return body_force(x); };
    solid.set_loads(loads);
    fem::LinearSolverOptions linear;
    linear.method = which.method;
    fem::StaticSolver<3> solver(solid, {}, linear);
    const auto           report = solver.advance_to(1);
    if (!report.converged)
      throw std::runtime_error("bench continuum: " + which.element_name() + ", " + which.solver_name() + ": " +
                               report.reason);
    ContinuumError row;
    row.cost       = base::processor_seconds() - start;
    row.which      = which;
    row.unknowns   = solid.dofs().n_dofs();
    row.iterations = solver.linear_iterations();
    row.error      = relative_error(solid, solver.displacement());
    return row;
  }
} // namespace apps
