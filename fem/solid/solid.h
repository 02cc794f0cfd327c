#pragma once

#include "base/state.h"
#include "fem/mesh/mesh.h"
#include "fem/points/material_points.h"
#include "fem/solid/element_blocks.h"
#include "fem/solid/loads.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <functional>

namespace fem
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  struct SolidOptions
  {
    unsigned int degree             = 1;             ///< 1 or 2
    Plane        plane              = Plane::strain; ///< in two dimensions
    double       thickness          = 1.0;           ///< [m], in two dimensions
    bool         large_displacement = false; ///< total Lagrangian: the material sees Green strain and 2nd Piola stress
    bool         mean_dilatation    = false; ///< volume change averaged over the element: no locking near nu = 0.5

    /// What part of the solid counts at an undeformed place [m], in (0, 1]: of mass, stiffness and weight; the rest belongs to
    /// another model in the same space. Empty: all, everywhere.
    std::function<double(const std::array<double, 3> &)> share = {};
  };

  /// The share of a place; 1 where nothing is said of it.
  template <int dim>
  double share_at(const SolidOptions &options, const dealii::Point<dim> &place)
  {
    return options.share ? options.share({place[0], place[1], dim == 3 ? place[dim - 1] : 0.0}) : 1.0;
  }

  /// What one sweep over the elements gives, at a displacement.
  struct Sweep
  {
    Vector *internal_force = nullptr; ///< [N], constrained rows included: there it is the reaction less the load
    Matrix *tangent        = nullptr; ///< [N/m], rows and columns of constrained displacements eliminated

    /// Products of the full (not eliminated) tangent with these vectors: input and result.
    std::vector<std::pair<const Vector *, Vector *>> products;
  };

  /// One integration point as an observer sees it.
  template <int dim>
  struct PointView
  {
    typename dealii::DoFHandler<dim>::active_cell_iterator cell;
    dealii::Point<dim>                                     place; ///< [m], undeformed
    double          volume; ///< its share, thickness included, of what counts there [m^3]
    base::Voigt     strain, stress;
    MaterialPoints *material;
    std::size_t     index; ///< of the point in its material
  };

  template <int dim>
  class NonlocalCoupling;
  template <int dim>
  class PointSearch;

  /// Mesh, degrees of freedom, supports, loads and the histories of the integration points of one continuum.
  template <int dim>
  class Solid
  {
  public:
    /// @throws base::InputError on options that do not fit together.
    Solid(Mesh<dim> mesh, const SolidOptions &options);
    ~Solid();

    /// Gives a material to the elements of that name (every name of the mesh needs one).
    void assign(const std::string &material_name, std::unique_ptr<MaterialPoints> points);

    /// Sets supports and loads; call once, after every assign().
    /// @throws base::InputError on an unknown boundary, contradicting displacements, a force outside the solid, a material
    ///         without law, or supports that leave a rigid motion free.
    void set_loads(const Loads<dim> &loads);

    /// A zero vector that can hold displacements or forces (ghosted; call update_ghost_values() after writing).
    Vector make_vector() const;

    /// An empty tangent with the right sparsity.
    void make_matrix(Matrix &matrix) const;

    /// Prescribed displacements at a time, on the constrained entries; zero elsewhere. [m]
    void prescribed(double time, Vector &values) const;

    /// Loads at a time [N].
    void external_force(double time, Vector &force) const;

    /// One pass over all elements; the trial histories become those of this displacement.
    /// @throws MaterialFailure on every rank if a point of any rank fails.
    void sweep(const Vector &displacement, const Sweep &wanted);

    /// Internal forces [N] alone, as by sweep(): by the fast kernel where the solid has one (has_blocks()), without any histories.
    /// @throws MaterialFailure
    void internal_force(const Vector &displacement, Vector &force);

    /// Whether the elements of this solid fit the fast kernel: linear elastic, small strain, no mean dilatation.
    bool has_blocks() const;

    /// The locally owned elements for the fast kernel, with positions in a make_vector(); made on first request.
    const std::vector<ElementBlocks> &blocks() const;

    /// A solver seeks another step from the committed histories: nothing of an attempt before shall matter.
    void begin_step();

    /// The next sweep is at the end of a step in time of this length [s].
    void begin_motion(double length);

    /// What the points dissipate from their committed to their trial histories, in a step that began with begin_step() [J].
    Dissipation dissipated() const;

    /// Trial histories become the committed ones.
    void commit();

    /// Shows every locally owned point at a displacement, history as committed; the trial histories are those of this displacement after.
    void visit_points(const Vector &displacement, const std::function<void(const PointView<dim> &)> &visit);

    /// Shows the committed history of every locally owned point, always in the same order; writing through the pointers changes it.
    void visit_histories(const StateColumn &column);

    /// All that the locally owned points remember: their histories, and what their materials remember beside them.
    void visit_state(base::StateVisitor &visitor);

    /// The same in memory, and back.
    base::Column saved_points();
    void         restore_points(const base::Column &saved);

    /// What users should know of the state by the materials of all ranks, and how it came about.
    std::vector<std::string> notes() const;

    /// Why no state after this one is worth anything, by one of the materials of any rank; "": none.
    std::string end_of_validity() const;

    /// Homogeneous constraints: the supported degrees of freedom.
    const dealii::AffineConstraints<double> &constraints() const { return supports; }

    const dealii::DoFHandler<dim> &dofs() const { return dof_handler; }
    const dealii::Mapping<dim>    &mapping() const { return *geometry; }
    const dealii::Quadrature<dim> &quadrature() const { return points; }
    const Mesh<dim>               &mesh() const { return grid; }
    const SolidOptions            &options() const { return settings; }
    MPI_Comm                       communicator() const { return dof_handler.get_communicator(); }

    /// Whether stress is linear in displacement everywhere.
    bool linear() const;

    /// Where one element keeps its points: its material, and the index of its first point there.
    struct ElementPoints
    {
      MaterialPoints *material = nullptr;
      std::size_t     first    = 0;
      ElementExtent   extent;
    };

    /// The material of each group of elements, by its name; the same on every rank.
    const std::map<std::string, std::unique_ptr<MaterialPoints>> &groups() const { return materials; }

    /// Material of the elements with this number.
    const MaterialPoints &material(const dealii::types::material_id id) const { return *material_of.at(id); }

    /// Points of the locally owned elements, in the order of iteration over them.
    const std::vector<ElementPoints> &element_points() const { return elements; }

    /// The search for elements around points; made on first request.
    const PointSearch<dim> &point_search() const;

    /// Weights of the displacements of the element around a point: value = sum weight u[dof], for one component.
    /// Empty on all ranks but one. @throws base::InputError if the point lies outside the solid.
    std::vector<std::pair<dealii::types::global_dof_index, double>> interpolation(const dealii::Point<dim> &where,
                                                                                  unsigned int component) const;

    /// Locally owned displacements of one component on a boundary. @throws base::InputError on an unknown one.
    std::vector<dealii::types::global_dof_index> boundary_dofs(const std::string &boundary,
                                                               unsigned int       component) const;

    /// Locally owned displacements of one component in a box, of nodes that lie in it to 1e-6 of the mesh's extent.
    std::vector<dealii::types::global_dof_index>
    dofs_within(const dealii::Point<dim> &low, const dealii::Point<dim> &high, unsigned int component) const;

  private:
    struct PrescribedDof
    {
      dealii::Point<dim> place;
      unsigned int       component;
      ScalarOf<dim>      value;
    };

    struct NodalForce
    {
      std::vector<std::pair<dealii::types::global_dof_index, double>> weights[dim];
      std::function<dealii::Tensor<1, dim>(double)>                   value;
    };

    /// An integration point on a loaded face: what its traction is multiplied by for the forces of the element.
    struct SurfacePoint
    {
      dealii::Point<dim>       place;
      dealii::Tensor<1, dim>   normal;
      std::vector<std::size_t> tractions, pressures; // of the loads
      std::vector<std::pair<unsigned int, std::pair<unsigned int, double>>>
        weights; // position, component, weight [m^2]
    };

    void allocate_points();
    void place_gathered_points();
    void gather(const Vector &displacement, bool with_tangent);
    void place_supports();
    void add_prescribed(dealii::types::global_dof_index dof,
                        unsigned int                    component,
                        const dealii::Point<dim>       &place,
                        const ScalarOf<dim>            &value);
    void hold_boundary(const PrescribedDisplacement<dim> &p);

    /// visit(cell, local index, global index, component, place()) for every node of every known element, repeatedly for shared ones.
    template <typename Visit>
    void visit_nodes(const Visit &visit) const;

    void hold_node(const PrescribedNode<dim> &node);
    void hold_box(const PrescribedBox<dim> &box);
    void hold_rigid_motion();
    void refuse_free_motion() const;
    void place_forces();
    void place_surface_loads();
    void add_surface_loads(double time, Vector &force) const;
    void add_body_force(double time, Vector &force) const;

    Mesh<dim>                                                  grid;
    SolidOptions                                               settings;
    std::unique_ptr<dealii::Mapping<dim>>                      geometry;
    std::unique_ptr<dealii::FESystem<dim>>                     element;
    dealii::Quadrature<dim>                                    points, load_points;
    dealii::Quadrature<dim - 1>                                face_points;
    dealii::DoFHandler<dim>                                    dof_handler;
    dealii::IndexSet                                           owned, relevant;
    dealii::AffineConstraints<double>                          supports;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::map<std::string, std::unique_ptr<MaterialPoints>>     materials;
    std::map<dealii::types::material_id, MaterialPoints *>     material_of;
    mutable std::vector<ElementBlocks>                         element_blocks;
    mutable std::shared_ptr<const PointSearch<dim>>            search;
    std::vector<ElementPoints>                                 elements;
    std::unique_ptr<NonlocalCoupling<dim>>                     nonlocal; // where damage is averaged over a length
    bool       gathers = false;                                          // answers of some points are found together
    Loads<dim> loads;
    std::map<dealii::types::global_dof_index, PrescribedDof> prescribed_dofs; // relevant ones
    std::vector<NodalForce>                                  nodal_forces;
    std::vector<SurfacePoint>                                surface_points;
    Vector                                                   steady_body_force; // integrated once, if it is steady
  };
}
