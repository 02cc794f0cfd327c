#pragma once

#include <deal.II/distributed/tria_base.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace fem
{
  /// Shape of the elements: quadrilaterals and hexahedra, or triangles and tetrahedra.
  enum class ElementFamily
  {
    hypercube,
    simplex
  };

  /// A mesh spread over the ranks, with the names by which a user speaks of its parts.
  template <int dim>
  struct Mesh
  {
    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> triangulation;
    ElementFamily                                             family = ElementFamily::hypercube;
    std::map<std::string, dealii::types::boundary_id>         boundaries;
    std::map<std::string, dealii::types::material_id>         materials;

    /// @throws std::invalid_argument naming the boundary asked for and those that exist.
    dealii::types::boundary_id boundary(const std::string &name) const;
  };

  /// Fills an empty triangulation with hexahedra or quadrilaterals; refinement included.
  template <int dim>
  using BuildMesh = std::function<void(dealii::Triangulation<dim> &)>;

  /**
   * Spreads what `build` makes over the ranks.
   *
   * Hypercubes go to `parallel::distributed`; simplices (8 triangles for a quadrilateral, 24 tetrahedra for a
   * hexahedron) are partitioned by METIS in a `parallel::shared` mesh, which every rank holds as a whole. Boundaries and materials are named by
   * their numbers until the caller gives names.
   * @throws std::invalid_argument on an inverted element or a mesh that falls into unconnected parts.
   */
  template <int dim>
  Mesh<dim> make_mesh(const BuildMesh<dim> &build, ElementFamily family, MPI_Comm communicator = MPI_COMM_WORLD);

  /// Spreads a serial mesh that is already made, of either family (every rank holds the same copy).
  template <int dim>
  Mesh<dim> distribute_mesh(dealii::Triangulation<dim> &serial, MPI_Comm communicator = MPI_COMM_WORLD);
}
