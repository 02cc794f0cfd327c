#include "dem/linear/linear_solver.h"

#include "base/errors.h"
#include "dem/linear/rigid_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace dem
{
  namespace
  {
    using PerLoad = std::array<double, load_lanes>;

    /** Iterations before the direct method is thought of; doubled from check to check. */
    constexpr int first_interval = 500;

    /** Multiplications and additions of one iteration, counted in the kernels. */
    double operations_per_iteration(const StiffnessOperator &stiffness)
    {
      return load_lanes * (2.0 * 75 * static_cast<double>(stiffness.links()) +
                           (72.0 + 10 * motions) * static_cast<double>(stiffness.particles()));
    }

    /** Of a factorisation and three solutions with all lanes. */
    double operations_of(const FactorCost &factor) { return factor.operations + 3 * load_lanes * 4 * factor.bytes / 8; }

    class LinearSolution
    {
    public:
      LinearSolution(const StiffnessOperator &k,
                     const Fields            &loads,
                     Fields                  &solution,
                     const LaneStrains       &macroscopic,
                     const SolverParameters  &parameters)
        : stiffness(k)
        , x(solution)
        , strain(macroscopic)
        , p(parameters)
        , b(solution.size())
      {
        fill_probes(stiffness, x);
        {
          const Fields none(x.size(), 0.0);
          stiffness.apply(none, strain, b);
        }
        for (std::size_t i = 0; i < b.size(); ++i)
          b[i] = (loads.empty() ? 0.0 : loads[i]) - b[i];
        start_reference = stiffness.link_force_norm(x, strain);
        add_loads(loads);
        reference = start_reference;
      }

      /** Iterate until converged, or `most` more iterations are spent. @return whether converged */
      template <typename Method>
      bool iterate(const Method &method, const Preconditioner &preconditioner, const int most)
      {
        const int end = report.iterations + most;
        while (report.iterations < end)
          {
            const IterationReport r =
              method(stiffness, preconditioner, b, x, reference, IterationLimits{p.tolerance, end - report.iterations});
            report.iterations += r.iterations;
            report.residual  = *std::max_element(r.residual.begin(), r.residual.begin() + first_probe);
            largest_residual = r.largest_residual();
            if (!r.converged)
              return false;
            if (!tighten_reference())
              return report.converged = true;
          }
        return false;
      }

      /** Iterations still to come if the residual goes on falling as over the last `done`. */
      double predicted_iterations(const double before, const int done) const
      {
        const double fall = std::log(before / largest_residual) / done;
        return fall > 0 ? std::log(largest_residual / p.tolerance) / fall : std::numeric_limits<double>::infinity();
      }

      const StiffnessOperator &stiffness;
      Fields                  &x;
      const LaneStrains       &strain;
      const SolverParameters  &p;
      Fields                   b;
      SolverReport             report;
      double                   largest_residual = 1; ///< probes included

    private:
      /** A load alone, without any link force at the start, is what the residual is compared with. */
      void add_loads(const Fields &loads)
      {
        for (std::size_t i = 0; i < loads.size(); ++i)
          squares[i % load_lanes] += loads[i] * loads[i];
        for (int lane = 0; lane < first_probe; ++lane)
          start_reference[lane] = std::hypot(start_reference[lane], std::sqrt(squares[lane]));
      }

      /**
       * Link forces of the solution may be far smaller than those of the start (a displacement prescribed to a few
       * particles); then the residual must follow. Not below 1e-2 of the start: under a rigid motion, or in a
       * cell that nothing spans, all link forces vanish.
       */
      bool tighten_reference()
      {
        const PerLoad now      = stiffness.link_force_norm(x, strain);
        bool          tightens = false;
        for (int lane = 0; lane < first_probe; ++lane)
          {
            const double next = std::max(now[lane], 1e-2 * start_reference[lane]);
            if (next < 0.5 * reference[lane])
              {
                reference[lane] = next;
                tightens        = true;
              }
          }
        return tightens;
      }

      PerLoad start_reference, reference, squares{};
    };

    /** Factorise and refine. @return whether converged */
    bool solve_directly(LinearSolution &solution, SparseFactor &factor)
    {
      factor.factorise(solution.stiffness);
      solution.report.method = SolverMethod::direct;
      solution.report.operations += operations_of(factor.cost());
      constexpr int refinements = 60; // one or two do, unless the network is at the edge of rigidity
      return solution.iterate(refine, factor, refinements);
    }

    // Operations of either kind weigh the same: on one core with OpenBLAS the factor of 4000 spheres runs at 3.6e10 of them a second,
    // the iteration at 3.3e10 (breccia bench homogenise; with the reference BLAS the factor is fourteen times slower).
    bool worth_factorising(const LinearSolution &solution, const FactorCost &factor, const double operations_to_come)
    {
      return factor.bytes < solution.p.memory_limit && operations_of(factor) < operations_to_come;
    }

    /** The particles' own blocks; for many particles also rigid motions of groups. */
    struct Preconditioning
    {
      Preconditioning(const StiffnessOperator &stiffness, const RowShare &share)
        : operations(operations_per_iteration(stiffness))
      {
        if (stiffness.particles() < RigidGroups::fewest_particles)
          {
            by = std::make_unique<BlockJacobi>(stiffness, share.own());
            return;
          }
        auto both = std::make_unique<BlocksAndGroups>(stiffness, share);
        operations += both->operations();
        by = std::move(both);
      }

      std::unique_ptr<Preconditioner> by;
      double                          operations; ///< of an iteration
    };

    void solve_automatically(LinearSolution &solution)
    {
      RowShare              share(solution.stiffness, solution.p.ranks);
      const Preconditioning preconditioning(solution.stiffness, share);
      const auto            iteration = [&share](auto &&...system) { return conjugate_gradients(system..., share); };
      std::unique_ptr<SparseFactor> factor;
      const bool                    may_switch = solution.p.method == SolverMethod::automatic;
      double                        before     = 1;
      for (int interval = first_interval; solution.report.iterations < solution.p.max_iterations; interval *= 2)
        {
          const int chunk = std::min(interval, solution.p.max_iterations - solution.report.iterations);
          solution.report.operations += chunk * preconditioning.operations;
          if (solution.iterate(iteration, *preconditioning.by, chunk))
            return;
          if (!may_switch)
            continue;
          if (!factor)
            {
              factor                 = std::make_unique<SparseFactor>(solution.stiffness);
              solution.report.factor = factor->cost();
            }
          if (worth_factorising(solution, factor->cost(),
                                solution.predicted_iterations(before, chunk) * preconditioning.operations))
            {
              solve_directly(solution, *factor);
              return;
            }
          before = solution.largest_residual;
        }
    }
  } // namespace

  std::string SolverReport::text() const
  {
    std::ostringstream out;
    out << (method == SolverMethod::direct ? "direct (sparse Cholesky), " : "iterative (conjugate gradients), ")
        << iterations << " iterations, residual " << residual << (converged ? "" : "; the tolerance was not reached");
    return out.str();
  }

  SolverReport solve_linear(const StiffnessOperator &stiffness,
                            const Fields            &b,
                            Fields                  &x,
                            const LaneStrains       &strain,
                            const bool               translates,
                            const SolverParameters  &parameters)
  {
    LinearSolution solution(stiffness, b, x, strain, parameters);
    if (parameters.method == SolverMethod::direct)
      {
        SparseFactor factor(stiffness);
        solution.report.factor = factor.cost();
        solve_directly(solution, factor);
      }
    else
      solve_automatically(solution);
    solution.report.mechanisms = find_mechanisms(stiffness, x, translates);
    return solution.report;
  }
} // namespace dem
