#include "fem/solvers/linear_solver.h"

#include "fem/solvers/geometric_multigrid.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    class Umfpack : public LinearSolver
    {
    public:
      explicit Umfpack(const std::string &why)
        : reason(why)
      {
      }

      void set_matrix(const Matrix &matrix) override
      {
        if (pattern.n_rows() != matrix.m())
          {
            DynamicSparsityPattern dynamic(matrix.m(), matrix.n());
            for (const auto &entry : matrix)
              dynamic.add(entry.row(), entry.column());
            local.clear();
            pattern.copy_from(dynamic);
            local.reinit(pattern);
          }
        local.copy_from(matrix);
        try
          {
            factors.initialize(local);
          }
        catch (const ExceptionBase &)
          {
            throw MaterialFailure("the tangent stiffness is singular.");
          }
      }

      void solve(Vector &solution, const Vector &right_side) override
      {
        dealii::Vector<double> x(right_side.size());
        for (types::global_dof_index i = 0; i < right_side.size(); ++i)
          x[i] = right_side[i];
        factors.solve(x);
        for (types::global_dof_index i = 0; i < right_side.size(); ++i)
          solution[i] = x[i];
      }

      std::string description() const override { return "UMFPACK, " + reason; }

    private:
      std::string          reason;
      SparsityPattern      pattern;
      SparseMatrix<double> local;
      SparseDirectUMFPACK  factors;
    };

    class Multigrid : public LinearSolver
    {
    public:
      Multigrid(const std::string             &why,
                const LinearSolverOptions     &o,
                const bool                     symmetric_,
                std::vector<std::vector<bool>> modes_,
                const bool                     quadratic)
        : reason(why)
        , options(o)
        , symmetric(symmetric_)
        , modes(std::move(modes_))
      {
        settings.constant_modes        = modes;
        settings.elliptic              = true;
        settings.higher_order_elements = quadratic;
        settings.smoother_sweeps       = 2;
        settings.aggregation_threshold = 0.02;
      }

      void set_matrix(const Matrix &given) override
      {
        matrix = &given;
        preconditioner.initialize(given, settings);
      }

      void solve(Vector &solution, const Vector &right_side) override
      {
        solution = 0;
        SolverControl control(options.iterations, options.tolerance * right_side.l2_norm());
        try
          {
            if (symmetric)
              SolverCG<Vector>(control).solve(*matrix, solution, right_side, preconditioner);
            else
              SolverGMRES<Vector>(control, SolverGMRES<Vector>::AdditionalData(100))
                .solve(*matrix, solution, right_side, preconditioner);
          }
        catch (const SolverControl::NoConvergence &failure)
          {
            throw MaterialFailure("the linear solver did not converge in " + std::to_string(failure.last_step) +
                                  " iterations.");
          }
        last = control.last_step();
      }

      std::string description() const override
      {
        return std::string(symmetric ? "conjugate gradients" : "GMRES") + " with algebraic multigrid, " + reason;
      }

      unsigned int iterations() const override { return last; }

    private:
      std::string                                       reason;
      LinearSolverOptions                               options;
      bool                                              symmetric;
      std::vector<std::vector<bool>>                    modes;
      TrilinosWrappers::PreconditionAMG::AdditionalData settings;
      TrilinosWrappers::PreconditionAMG                 preconditioner;
      const Matrix                                     *matrix = nullptr;
      unsigned int                                      last   = 0;
    };
  }

  template <int dim>
  std::unique_ptr<LinearSolver>
  make_linear_solver(const Solid<dim> &solid, const LinearSolverOptions &options, const bool symmetric)
  {
    const auto unknowns = solid.dofs().n_dofs();
    const bool alone    = Utilities::MPI::n_mpi_processes(solid.communicator()) == 1;
    if (options.method == LinearMethod::direct && !alone)
      throw std::invalid_argument(
        "linear solver = direct: works on one rank only. Use the iterative one, or start one rank.");
    const auto        limit  = options.direct_limit > 0 ? options.direct_limit : (dim == 2 ? 200000u : 30000u);
    const bool        direct = alone && (options.method == LinearMethod::direct ||
                                  (options.method == LinearMethod::automatic && unknowns <= limit));
    std::string       why    = options.method != LinearMethod::automatic ? "as asked" :
                               !alone                                    ? "several ranks" :
                                                                           std::to_string(unknowns) +
                                       (direct ? " unknowns: not more than " : " unknowns: more than ") +
                                       std::to_string(limit);
    if (direct)
      return std::make_unique<Umfpack>(why);
    std::string obstacle;
    if (options.method == LinearMethod::automatic || options.method == LinearMethod::geometric)
      {
        auto geometric = make_geometric_multigrid(solid, options, why, obstacle);
        if (geometric)
          return geometric;
        if (options.method == LinearMethod::geometric)
          throw std::invalid_argument("linear solver = geometric: " + obstacle + ". Use the iterative one.");
      }
    std::vector<std::vector<bool>> modes;
    DoFTools::extract_constant_modes(solid.dofs(), ComponentMask(dim, true), modes);
    if (!obstacle.empty() && symmetric)
      why += "; not geometric, for " + obstacle;
    return std::make_unique<Multigrid>(why, options, symmetric, modes, solid.options().degree > 1);
  }

  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<2> &, const LinearSolverOptions &, bool);
  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<3> &, const LinearSolverOptions &, bool);
}
