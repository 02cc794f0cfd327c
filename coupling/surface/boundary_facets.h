#pragma once

#include "coupling/participants/solid_participant.h"
#include "dem/facets/facet_mesh.h"

#include <array>
#include <string>
#include <vector>

namespace coupling
{
  /** The boundary of a solid as facets whose vertices are its nodes. */
  struct BoundaryFacets
  {
    dem::FacetMesh           mesh;    ///< vertices where the nodes are now: first the nodes, then the middles of faces
    std::vector<std::size_t> carrier; ///< of each vertex that is a node, as the participant numbers it
    std::vector<std::array<std::size_t, 4>> middle; ///< of each other vertex: the nodes (vertices) whose mean it is
  };

  /** How a quadrilateral becomes triangles. */
  enum class QuadrilateralSplit
  {
    diagonal, ///< two, along the diagonal of their first and last corner
    middle    ///< four, about their middle: as symmetric as the face
  };

  /**
   * Faces of named parts of the boundary, in the order of the elements: triangles; quadrilaterals split; in the plane segments.
   *
   * @param names of boundaries of the mesh; empty: the whole boundary
   * @throws base::InputError for a name that the mesh does not have, or a part without faces
   */
  template <int dim>
  BoundaryFacets boundary_facets(const fem::Solid<dim>          &solid,
                                 const SolidParticipant<dim>    &participant,
                                 const std::vector<std::string> &names,
                                 QuadrilateralSplit              split = QuadrilateralSplit::diagonal);
} // namespace coupling
