#include "fem/solvers/geometric_multigrid.h"

#include "fem/solid/block_builder.h"
#include "fem/solid/rigid_motion.h"
#include "fem/solvers/coarsest_level.h"
#include "fem/solvers/elastic_operator.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/multigrid/mg_transfer_matrix_free.h>

namespace fem
{
  using namespace dealii;

  namespace
  {
    using LevelVector = LinearAlgebra::distributed::Vector<float>; // a preconditioner needs no more than six digits

    /// The operator of one level and its smoother.
    struct Level
    {
      using Smoother = PreconditionChebyshev<ElasticOperator<float>, LevelVector, DiagonalMatrix<LevelVector>>;

      std::shared_ptr<const Utilities::MPI::Partitioner> layout;
      std::vector<ElementBlocksOf<float>>                elements;
      std::vector<unsigned int>                          held;
      ElasticOperator<float>                             stiffness;
      Smoother                                           smoother;
      double                                             largest_diagonal = 0;
    };

    template <int dim>
    class GeometricMultigrid : public LinearSolver
    {
    public:
      GeometricMultigrid(const Solid<dim> &solid_, const LinearSolverOptions &options_, const std::string &why_)
        : solid(solid_)
        , options(options_)
        , why(why_)
        , dofs(*solid.mesh().triangulation)
      {
        dofs.distribute_dofs(solid.dofs().get_fe()); // the same numbers as the solid's
        dofs.distribute_mg_dofs();
        const unsigned int n = solid.mesh().triangulation->n_global_levels();
        levels.resize(0, n - 1);
        x.resize(0, n - 1);
        b.resize(0, n - 1);
        r.resize(0, n - 1);
        for (unsigned int l = 0; l < n; ++l)
          {
            IndexSet relevant;
            DoFTools::extract_locally_relevant_level_dofs(dofs, l, relevant);
            levels[l].layout = std::make_shared<const Utilities::MPI::Partitioner>(dofs.locally_owned_mg_dofs(l),
                                                                                   relevant, solid.communicator());
            for (auto *v : {&x, &b, &r})
              (*v)[l].reinit(levels[l].layout);
          }
        transfer.build(dofs, [this](const unsigned int l, LevelVector &v) { v.reinit(levels[l].layout); });
        find_held();
      }

      /// The rigid motion that the supports leave to the coarsest level; empty if none.
      std::string free_on_coarsest() const
      {
        std::vector<Point<dim>> corners; // every rank holds all elements of the coarsest level
        for (const auto &cell : dofs.get_triangulation().cell_iterators_on_level(0))
          for (unsigned int v = 0; v < cell->n_vertices(); ++v)
            corners.push_back(cell->vertex(v));
        const BoundingBox<dim> box(corners);
        RigidMotion<dim>       motion(box.get_boundary_points().first,
                                box.get_boundary_points().first.distance(box.get_boundary_points().second));
        std::vector<types::global_dof_index> indices(dofs.get_fe().n_dofs_per_cell());
        for (const auto &cell : dofs.mg_cell_iterators_on_level(0))
          if (cell->is_locally_owned_on_level())
            {
              cell->get_mg_dof_indices(indices);
              for (unsigned int i = 0; i < indices.size(); ++i)
                if (held_on_coarsest.is_constrained(indices[i]))
                  motion.hold(solid.mapping().transform_unit_to_real_cell(cell, dofs.get_fe().unit_support_point(i)),
                              dofs.get_fe().system_to_component_index(i).first);
            }
        return motion.free_motion(solid.communicator());
      }

      void set_up()
      {
        for (unsigned int l = 1; l < dofs.get_triangulation().n_global_levels(); ++l)
          set_up_level(l);
        coarsest = std::make_unique<CoarsestLevel<dim>>(solid, dofs, levels[0].layout, held_on_coarsest);
        std::vector<unsigned int> held;
        const auto                layout = solid.make_vector().get_partitioner();
        for (unsigned int i = 0; i < layout->locally_owned_size(); ++i)
          if (solid.constraints().is_constrained(layout->local_to_global(i)))
            held.push_back(i);
        stiffness.reinit(solid.blocks(), layout, held);
      }

      bool   wants_matrix() const override { return false; }
      double matrix_size() const override { return levels[levels.max_level()].largest_diagonal; }
      void   set_matrix(const Matrix &) override {}

      void solve(Vector &solution, const Vector &right_side) override
      {
        solution = 0;
        SolverControl control(options.iterations, options.tolerance * right_side.l2_norm());
        try
          {
            SolverCG<Vector>(control).solve(stiffness, solution, right_side, *this);
          }
        catch (const SolverControl::NoConvergence &failure)
          {
            throw MaterialFailure("the linear solver did not converge in " + std::to_string(failure.last_step) +
                                  " iterations.");
          }
        last = control.last_step();
      }

      /// The preconditioner: one V-cycle. The scale keeps single precision away from its limits.
      void vmult(Vector &correction, const Vector &residual) const
      {
        const unsigned int top  = levels.max_level();
        const double       size = residual.linfty_norm();
        correction              = 0;
        if (size == 0)
          return;
        transfer.copy_to_mg(dofs, b, residual);
        b[top] *= static_cast<float>(1 / size);
        set_zero(b[top], levels[top].held);
        cycle(top);
        transfer.copy_from_mg(dofs, correction, x);
        correction *= size;
      }

      std::string description() const override
      {
        return "conjugate gradients with geometric multigrid of " + std::to_string(levels.max_level() + 1) +
               " levels (" + coarsest->description() + "), no matrix, " + why;
      }

      unsigned int iterations() const override { return last; }

    private:
      /// A node of a coarser level is held where the same node of the finest is.
      void find_held()
      {
        Vector flags = solid.make_vector();
        for (unsigned int i = 0; i < flags.locally_owned_size(); ++i)
          flags.local_element(i) = solid.constraints().is_constrained(flags.get_partitioner()->local_to_global(i));
        transfer.interpolate_to_mg(dofs, x, flags);
        for (unsigned int l = 0; l <= levels.max_level(); ++l)
          {
            for (unsigned int i = 0; i < x[l].locally_owned_size(); ++i)
              if (x[l].local_element(i) > 0.5f)
                levels[l].held.push_back(i);
            if (l > 0)
              {
                x[l].reinit(levels[l].layout);
                continue;
              }
            LevelVector all(levels[0].layout);
            all.copy_locally_owned_data_from(x[0]);
            all.update_ghost_values();
            IndexSet relevant;
            DoFTools::extract_locally_relevant_level_dofs(dofs, 0, relevant);
            held_on_coarsest.reinit(relevant);
            for (const types::global_dof_index dof : relevant)
              if (all[dof] > 0.5f)
                held_on_coarsest.add_line(dof);
            held_on_coarsest.close();
            x[0].reinit(levels[0].layout);
          }
      }

      void set_up_level(const unsigned int l)
      {
        Level                               &level = levels[l];
        BlockBuilder<dim, float>             builder(solid);
        std::vector<types::global_dof_index> indices(dofs.get_fe().n_dofs_per_cell());
        std::vector<unsigned int>            positions(indices.size());
        for (const auto &cell : dofs.mg_cell_iterators_on_level(l))
          if (cell->is_locally_owned_on_level())
            {
              cell->get_mg_dof_indices(indices);
              for (unsigned int i = 0; i < indices.size(); ++i)
                positions[i] = level.layout->global_to_local(indices[i]);
              builder.add(cell, positions, material_of(solid, cell));
            }
        level.elements = builder.take();
        level.stiffness.reinit(level.elements, level.layout, level.held);

        typename Level::Smoother::AdditionalData settings;
        settings.degree              = 4;
        settings.smoothing_range     = 16;
        settings.eig_cg_n_iterations = 12;
        settings.preconditioner      = std::make_shared<DiagonalMatrix<LevelVector>>();
        LevelVector &diagonal        = settings.preconditioner->get_vector();
        level.stiffness.diagonal(diagonal);
        level.largest_diagonal = diagonal.linfty_norm();
        for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
          diagonal.local_element(i) = 1 / diagonal.local_element(i);
        level.smoother.initialize(level.stiffness, settings);
      }

      /// x = approximate inverse of b on this level.
      void cycle(const unsigned int l) const
      {
        if (l == 0)
          {
            coarsest->solve(x[0], b[0]);
            return;
          }
        const Level &level = levels[l];
        level.smoother.vmult(x[l], b[l]);
        level.stiffness.vmult(r[l], x[l]);
        r[l].sadd(-1, 1, b[l]);
        set_zero(r[l], level.held);
        b[l - 1] = 0;
        transfer.restrict_and_add(l, b[l - 1], r[l]);
        set_zero(b[l - 1], levels[l - 1].held);
        cycle(l - 1);
        transfer.prolongate(l, r[l], x[l - 1]);
        set_zero(r[l], level.held);
        x[l] += r[l];
        level.smoother.step(x[l], b[l]);
        set_zero(x[l], level.held);
      }

      static void set_zero(LevelVector &v, const std::vector<unsigned int> &held)
      {
        for (const unsigned int i : held)
          v.local_element(i) = 0;
      }

      const Solid<dim>                         &solid;
      LinearSolverOptions                       options;
      std::string                               why;
      DoFHandler<dim>                           dofs;
      MGTransferMatrixFree<dim, float>          transfer;
      MGLevelObject<Level>                      levels;
      mutable MGLevelObject<LevelVector>        x, b, r;
      AffineConstraints<double>                 held_on_coarsest;
      std::unique_ptr<CoarsestLevel<dim>>       coarsest;
      ElasticOperator<double>                   stiffness;
      unsigned int                              last = 0;
    };
  }

  template <int dim>
  std::unique_ptr<LinearSolver> make_geometric_multigrid(const Solid<dim>          &solid,
                                                         const LinearSolverOptions &options,
                                                         const std::string         &why,
                                                         std::string               &obstacle)
  {
    const auto &mesh = *solid.mesh().triangulation;
    if (!solid.has_blocks())
      obstacle = "the solid is not linear elastic at small strain, or with mean dilatation";
    else if (solid.mesh().family != ElementFamily::hypercube)
      obstacle = "triangles and tetrahedra have no refinement levels";
    else if (mesh.n_global_levels() < 2)
      obstacle = "the mesh is not a refinement of a coarser one";
    else if (!mesh.is_multilevel_hierarchy_constructed())
      obstacle = "the mesh keeps no coarser levels";
    else
      {
        unsigned int coarser = 0;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() && cell->level() + 1 < static_cast<int>(mesh.n_global_levels()))
            coarser = 1;
        if (Utilities::MPI::max(coarser, mesh.get_communicator()) > 0)
          obstacle = "the mesh is refined in parts only";
      }
    if (!obstacle.empty())
      return nullptr;
    auto solver = std::make_unique<GeometricMultigrid<dim>>(solid, options, why);
    obstacle    = solver->free_on_coarsest();
    if (!obstacle.empty())
      {
        obstacle = "the supports do not hold its coarsest level (" + obstacle + ")";
        return nullptr;
      }
    solver->set_up();
    return solver;
  }

  template std::unique_ptr<LinearSolver>
  make_geometric_multigrid(const Solid<2> &, const LinearSolverOptions &, const std::string &, std::string &);
  template std::unique_ptr<LinearSolver>
  make_geometric_multigrid(const Solid<3> &, const LinearSolverOptions &, const std::string &, std::string &);
}
