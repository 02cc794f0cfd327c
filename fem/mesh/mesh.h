#pragma once

#include "fem/mesh/shape_sizes.h"

#include <deal.II/distributed/tria_base.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace fem
{
  /// What a mesh is made of: one connected body, or several.
  enum class Bodies
  {
    one,
    several
  };

  /// A mesh spread over the ranks, with the names by which a user speaks of its parts.
  template <int dim>
  struct Mesh
  {
    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> triangulation;
    ElementFamily                                             family = ElementFamily::hypercube;
    std::map<std::string, dealii::types::boundary_id>         boundaries;
    std::map<std::string, dealii::types::material_id>         materials;

    /// @throws base::InputError naming the requested boundary and those that exist.
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
   * @throws base::InputError on an inverted element, or one body that falls into unconnected parts.
   */
  template <int dim>
  Mesh<dim> make_mesh(const BuildMesh<dim> &build,
                      ElementFamily         family,
                      MPI_Comm              communicator = MPI_COMM_WORLD,
                      Bodies                bodies       = Bodies::one);

  /// Spreads a serial mesh that is already made, of either family (every rank holds the same copy).
  template <int dim>
  Mesh<dim> distribute_mesh(dealii::Triangulation<dim> &serial,
                            MPI_Comm                    communicator = MPI_COMM_WORLD,
                            Bodies                      bodies       = Bodies::one);
}
