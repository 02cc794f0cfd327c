#pragma once

#include "coupling/participants/solid_participant.h"
#include "dem/facets/facet_mesh.h"

#include <string>
#include <vector>

namespace coupling
{
  /** The boundary of a solid as facets whose vertices are its nodes. */
  struct BoundaryFacets
  {
    dem::FacetMesh           mesh;    ///< vertices where the nodes are now
    std::vector<std::size_t> carrier; ///< of each vertex: the node, as the participant numbers it
  };

  /**
   * Faces of named parts of the boundary: triangles; quadrilaterals split in two along the diagonal of their first and last corner, in
   * the order of the elements; in the plane segments.
   *
   * @param names of boundaries of the mesh; empty: the whole boundary
   * @throws std::invalid_argument for a name that the mesh does not have, or a part without faces
   */
  template <int dim>
  BoundaryFacets boundary_facets(const fem::Solid<dim>          &solid,
                                 const SolidParticipant<dim>    &participant,
                                 const std::vector<std::string> &names);
} // namespace coupling
