#include "apps/bench/continuum_rates.h"

#include "apps/bench/continuum_cases.h"
#include "apps/bench/plain_elasticity.h"
#include "apps/bench/results.h"
#include "base/stopwatch.h"
#include "fem/explicit/explicit_solver.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/solvers/static_solver.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace apps
{
  using namespace dealii;

  namespace
  {
    constexpr int repeats = 5;

    /** Shortest time of one call [s]; short calls are made several at a time, as the processor clock is coarse. */
    template <typename Clock, typename Action>
    double shortest(const Clock &clock, const Action &action)
    {
      action(); // memory and caches are ready
      const double first = clock();
      action();
      const int calls = std::clamp(static_cast<int>(0.05 / std::max(clock() - first, 1e-5)), 1, 200);
      double    best  = std::numeric_limits<double>::max();
      for (int i = 0; i < repeats; ++i)
        {
          const double start = clock();
          for (int call = 0; call < calls; ++call)
            action();
          best = std::min(best, (clock() - start) / calls);
        }
      return best;
    }

    /** An elastic cube held at x = 0 and pulled by a body force. */
    struct Cube
    {
      Cube(const unsigned int divisions, const MPI_Comm communicator)
        : solid(unit_cube(fem::ElementFamily::hypercube, divisions, communicator), {})
      {
        fem::IsotropicElasticParameters law;
        law.young_modulus = 30e9;
        law.poisson_ratio = 0.2;
        solid.assign("solid", fem::make_points(fem::IsotropicElastic(law), fem::Plane::strain));
        fem::Loads<3> loads;
        for (unsigned int c = 0; c < 3; ++c)
          loads.displacements.push_back({"left", c, [](const Point<3> &, double) { return 0.0; }});
        loads.tractions.push_back({"right", [](const Point<3> &, double t) { return Tensor<1, 3>({1e6 * t, 0, 0}); }});
        solid.set_loads(loads);
      }

      fem::Solid<3> solid;
    };

    fem::ExplicitOptions concrete_density()
    {
      fem::ExplicitOptions options;
      options.density = {{"solid", 2400.0}};
      return options;
    }
  } // namespace

  std::vector<ContinuumRate> measure_rates(const unsigned int divisions)
  {
    Cube              cube(divisions, MPI_COMM_SELF);
    PlainElasticity   plain(divisions);
    const std::size_t n = plain.unknowns();

    fem::Vector u = cube.solid.make_vector(), f = cube.solid.make_vector();
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      u.local_element(i) = 1e-6 * std::sin(0.1 * i);
    fem::Matrix matrix;
    cube.solid.make_matrix(matrix);
    fem::Sweep wanted;
    wanted.internal_force = &f;
    wanted.tangent        = &matrix;

    std::vector<ContinuumRate> rates;
    const auto                 add = [&](const char *operation, const double ours, const double theirs) {
      rates.push_back({operation, n, ours, theirs});
    };
    const auto clock = base::processor_seconds;
    add("assembly", shortest(clock, [&] { cube.solid.sweep(u, wanted); }), shortest(clock, [&] { plain.assemble(); }));
    add("product", shortest(clock, [&] { cube.solid.internal_force(u, f); }),
        shortest(clock, [&] { plain.multiply(); }));

    fem::LinearSolverOptions geometric;
    geometric.method           = fem::LinearMethod::geometric;
    const double         start = clock();
    fem::StaticSolver<3> solver(cube.solid, {}, geometric);
    solver.advance_to(1);
    const double ours = clock() - start;
    // The second load needs no set-up: iterations and three products.
    const double again = clock();
    solver.advance_to(2);
    const double       iteration   = (clock() - again) / solver.linear_iterations();
    const double       plain_start = clock();
    const unsigned int count       = plain.solve();
    const double       theirs      = clock() - plain_start;
    add("solver iteration", iteration, theirs / count);
    add("whole solution", ours, theirs + rates[0].plain);

    fem::ExplicitSolver<3> motion(cube.solid, concrete_density());
    add("explicit step", shortest(clock, [&] { motion.advance(motion.step()); }),
        shortest(clock, [&] { plain.step(1e-12); }));
    return rates;
  }

  RankFigures measure_on_ranks(const unsigned int divisions, const MPI_Comm communicator)
  {
    RankFigures figures;
    auto        lap = [&, last = MPI_Wtime()]() mutable {
      MPI_Barrier(communicator);
      const double now = MPI_Wtime(), passed = now - last;
      last = now;
      return passed;
    };
    Cube cube(divisions, communicator);
    figures.ranks    = static_cast<int>(Utilities::MPI::n_mpi_processes(communicator));
    figures.elements = cube.solid.mesh().triangulation->n_global_active_cells();
    figures.unknowns = cube.solid.dofs().n_dofs();
    figures.mesh     = lap();
    fem::LinearSolverOptions options;
    options.direct_limit = 1;
    fem::StaticSolver<3> solver(cube.solid, {}, options);
    figures.set_up    = lap();
    const auto report = solver.advance_to(1);
    figures.solution  = lap();
    figures.solver    = solver.linear_solver() + "; " + std::to_string(solver.linear_iterations()) + " iterations";
    if (!report.converged)
      throw std::runtime_error("bench continuum: " + report.reason);

    fem::ExplicitSolver<3> motion(cube.solid, concrete_density());
    const auto             wall = [communicator] {
      MPI_Barrier(communicator);
      return MPI_Wtime();
    };
    const double per_core = 8.0 * static_cast<double>(figures.elements) / figures.ranks;
    fem::Vector  f        = cube.solid.make_vector();
    // The same number of calls on every rank: they talk to each other.
    double kernel = std::numeric_limits<double>::max(), step = kernel;
    for (int i = 0; i < 4 * repeats; ++i)
      {
        double start = wall();
        motion.internal_force_at(solver.displacement(), f);
        kernel = std::min(kernel, wall() - start);
        start  = wall();
        motion.advance(motion.step());
        step = std::min(step, wall() - start);
      }
    figures.updates = per_core / step;
    figures.kernel  = per_core / kernel;
    return figures;
  }
} // namespace apps
