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
#include <deal.II/lac/trilinos_solver.h>

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

    /// A direct solver over all ranks.
    class Mumps : public LinearSolver
    {
    public:
      explicit Mumps(const std::string &why)
        : reason(why)
      {
      }

      void set_matrix(const Matrix &matrix) override
      {
        factors = std::make_unique<TrilinosWrappers::SolverDirect>(
          control, TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Mumps"));
        try
          {
            factors->initialize(matrix);
          }
        catch (const ExceptionBase &)
          {
            throw MaterialFailure("the tangent stiffness is singular.");
          }
      }

      void solve(Vector &solution, const Vector &right_side) override { factors->solve(solution, right_side); }

      std::string description() const override { return "MUMPS, " + reason; }

    private:
      std::string                                     reason;
      SolverControl                                   control;
      std::unique_ptr<TrilinosWrappers::SolverDirect> factors;
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
              // Preconditioned from the right: the residual it stops by is then that of the equations, a force.
              SolverGMRES<Vector>(control, SolverGMRES<Vector>::AdditionalData(100, true))
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
    const auto limit    = options.direct_limit > 0 ? options.direct_limit : (dim == 2 ? 200000u : 30000u);
    const bool direct   = options.method == LinearMethod::direct ||
                        (options.method == LinearMethod::automatic && alone && unknowns <= limit);
    std::string why = options.method != LinearMethod::automatic ? "as asked" :
                      !alone                                    ? "several ranks" :
                                                                  std::to_string(unknowns) +
                                 (direct ? " unknowns: not more than " : " unknowns: more than ") +
                                 std::to_string(limit);
    if (direct && alone)
      return std::make_unique<Umfpack>(why);
    if (direct)
      return std::make_unique<Mumps>(why);
    std::string obstacle;
    if (options.method == LinearMethod::automatic || options.method == LinearMethod::geometric)
      {
        auto geometric = make_geometric_multigrid(solid, options, why, obstacle);
        if (geometric)
          return geometric;
        if (options.method == LinearMethod::geometric)
          throw std::invalid_argument("linear solver = geometric: " + obstacle + ". Use the iterative one.");
      }
    // Translations of the owned displacements (deal.II's extract_constant_modes() fails on shared meshes).
    const IndexSet                       owned = solid.dofs().locally_owned_dofs();
    std::vector<std::vector<bool>>       modes(dim, std::vector<bool>(owned.n_elements(), false));
    std::vector<types::global_dof_index> indices(solid.dofs().get_fe().n_dofs_per_cell());
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (owned.is_element(indices[i]))
              modes[solid.dofs().get_fe().system_to_component_index(i).first][owned.index_within_set(indices[i])] =
                true;
        }
    if (!obstacle.empty() && symmetric)
      why += "; not geometric, for " + obstacle;
    return std::make_unique<Multigrid>(why, options, symmetric, modes, solid.options().degree > 1);
  }

  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<2> &, const LinearSolverOptions &, bool);
  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<3> &, const LinearSolverOptions &, bool);
}
