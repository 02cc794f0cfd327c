#include "fem/solvers/linear_solver.h"

#include "base/errors.h"
#include "base/solver_turns.h"
#include "fem/solvers/geometric_multigrid.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_MultiVector.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /**
     * Factors of the whole matrix on the first rank. Solvers that share the factorisation (MUMPS) sum in the order in which
     * messages happen to come: two runs would differ in their last digits.
     */
    class Umfpack : public LinearSolver
    {
    public:
      Umfpack(const std::string &why, const MPI_Comm comm)
        : reason(why)
        , communicator(comm)
        , is_first(Utilities::MPI::this_mpi_process(comm) == 0)
      {
      }

      void set_matrix(const Matrix &matrix) override
      {
        const std::unique_ptr<Epetra_CrsMatrix> gathered = gather(matrix.trilinos_matrix());
        int                                     singular = 0;
        if (is_first)
          {
            copy(*gathered);
            try
              {
                const auto turn = base::dense_kernels_turn();
                factors.initialize(local);
              }
            catch (const ExceptionBase &)
              {
                singular = 1;
              }
          }
        if (Utilities::MPI::max(singular, communicator) == 1)
          throw MaterialFailure("the tangent stiffness is singular.");
      }

      void solve(Vector &solution, const Vector &right_side) override
      {
        // Ranks own consecutive unknowns: one after the other they are the whole.
        std::vector<double> x(right_side.begin(), right_side.end());
        const auto          parts = Utilities::MPI::gather(communicator, x);
        if (is_first)
          {
            dealii::Vector<double> whole(right_side.size());
            auto                   next = whole.begin();
            for (const std::vector<double> &part : parts)
              next = std::copy(part.begin(), part.end(), next);
            factors.solve(whole);
            x.assign(whole.begin(), whole.end());
          }
        x = Utilities::MPI::broadcast(communicator, x);
        std::copy_n(x.begin() + right_side.get_partitioner()->local_range().first, right_side.locally_owned_size(),
                    solution.begin());
      }

      std::string description() const override { return "UMFPACK, " + reason; }

    private:
      /// All rows on the first rank, none on the others.
      std::unique_ptr<Epetra_CrsMatrix> gather(const Epetra_CrsMatrix &matrix)
      {
        const Epetra_Map target(-1, is_first ? matrix.NumGlobalRows() : 0, 0, matrix.Comm());
        if (!importer)
          importer = std::make_unique<Epetra_Import>(target, matrix.RowMap());
        auto whole = std::make_unique<Epetra_CrsMatrix>(Copy, target, 0);
        whole->Import(matrix, *importer, Insert);
        whole->FillComplete();
        return whole;
      }

      void copy(const Epetra_CrsMatrix &whole)
      {
        const auto visit_rows = [&](const auto &visit) {
          int     entries = 0, *columns = nullptr;
          double *values = nullptr;
          for (int row = 0; row < whole.NumMyRows(); ++row)
            {
              whole.ExtractMyRowView(row, entries, values, columns);
              for (int e = 0; e < entries; ++e)
                visit(row, whole.ColMap().GID(columns[e]), values[e]);
            }
        };
        if (pattern.n_rows() == 0)
          {
            DynamicSparsityPattern dynamic(whole.NumMyRows(), whole.NumMyRows());
            visit_rows([&](const int row, const int column, double) { dynamic.add(row, column); });
            pattern.copy_from(dynamic);
            local.reinit(pattern);
          }
        visit_rows([&](const int row, const int column, const double value) { local.set(row, column, value); });
      }

      std::string                    reason;
      MPI_Comm                       communicator;
      bool                           is_first;
      std::unique_ptr<Epetra_Import> importer;
      SparsityPattern                pattern;
      SparseMatrix<double>           local;
      SparseDirectUMFPACK            factors;
    };

    /**
     * What an elastic body without supports does not resist, which algebraic multigrid needs to keep it on its coarse levels (Vaněk, Mandel and
     * Brezina, 1996, Computing 56, 179): translations and rotations, at the unknowns of this rank, one motion after the other.
     */
    struct RigidMotions
    {
      int                 dimension;
      std::vector<double> values;

      int count() const { return dimension == 2 ? 3 : 6; }
    };

    template <int dim>
    RigidMotions rigid_motions(const Solid<dim> &solid)
    {
      const DoFHandler<dim>                        &dofs = solid.dofs();
      std::map<types::global_dof_index, Point<dim>> place;
      DoFTools::map_dofs_to_support_points(solid.mapping(), dofs, place);
      const IndexSet         owned = dofs.locally_owned_dofs();
      const auto             size  = owned.n_elements();
      RigidMotions           motions{dim, {}};
      const auto             count  = static_cast<std::size_t>(motions.count());
      const BoundingBox<dim> box    = GridTools::compute_bounding_box(dofs.get_triangulation());
      const Point<dim>       middle = box.center();
      const double           length = box.get_boundary_points().first.distance(box.get_boundary_points().second);
      motions.values.assign(count * size, 0.0);
      std::vector<types::global_dof_index> indices(dofs.get_fe().n_dofs_per_cell());
      for (const auto &cell : dofs.active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            {
              if (!owned.is_element(indices[i]))
                continue;
              const auto           at       = owned.index_within_set(indices[i]);
              const unsigned int   c        = dofs.get_fe().system_to_component_index(i).first;
              const Tensor<1, dim> x        = (place.at(indices[i]) - middle) / length;
              motions.values[c * size + at] = 1;
              for (unsigned int a = 0; a + dim < count; ++a) // about the third axis of the plane, or each of space
                {
                  const unsigned int first = dim == 2 ? 0 : (a + 1) % dim, second = dim == 2 ? 1 : (a + 2) % dim;
                  motions.values[(dim + a) * size + at] = c == first ? -x[second] : c == second ? x[first] : 0.0;
                }
            }
        }
      return motions;
    }

    class Multigrid : public LinearSolver
    {
    public:
      Multigrid(const std::string         &why,
                const LinearSolverOptions &o,
                const bool                 symmetric_,
                RigidMotions               motions_,
                const bool                 quadratic)
        : reason(why)
        , options(o)
        , symmetric(symmetric_)
        , motions(std::move(motions_))
      {
        settings.elliptic              = true;
        settings.higher_order_elements = quadratic;
        settings.smoother_sweeps       = 2;
        settings.aggregation_threshold = 0.02;
      }

      void set_matrix(const Matrix &given) override
      {
        matrix = &given;
        Teuchos::ParameterList              parameters;
        std::unique_ptr<Epetra_MultiVector> none;
        settings.set_parameters(parameters, none, given);
        parameters.set("PDE equations", motions.dimension);
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", motions.count());
        parameters.set("null space: vectors", motions.values.data());
        preconditioner.initialize(given, parameters);
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
      RigidMotions                                      motions;
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
    const auto limit    = options.direct_limit > 0 ? options.direct_limit : (dim == 2 ? 200000u : 30000u);
    const bool direct =
      options.method == LinearMethod::direct || (options.method == LinearMethod::automatic && unknowns <= limit);
    std::string why = options.method != LinearMethod::automatic ?
                        "as requested" :
                        std::to_string(unknowns) + (direct ? " unknowns: not more than " : " unknowns: more than ") +
                          std::to_string(limit);
    if (direct)
      return std::make_unique<Umfpack>(why, solid.communicator());
    std::string obstacle;
    if (options.method == LinearMethod::automatic || options.method == LinearMethod::geometric)
      {
        auto geometric = make_geometric_multigrid(solid, options, why, obstacle);
        if (geometric)
          return geometric;
        if (options.method == LinearMethod::geometric)
          throw base::InputError("linear solver = geometric: " + obstacle + ". Use the iterative one.");
      }
    if (!obstacle.empty() && symmetric)
      why += "; not geometric, for " + obstacle;
    return std::make_unique<Multigrid>(why, options, symmetric, rigid_motions(solid), solid.options().degree > 1);
  }

  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<2> &, const LinearSolverOptions &, bool);
  template std::unique_ptr<LinearSolver> make_linear_solver(const Solid<3> &, const LinearSolverOptions &, bool);
}
