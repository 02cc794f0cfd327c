#pragma once

#include "coupling/contact/bodies/body_mesh.h"
#include "coupling/participants/solid_participant.h"

#include <string>
#include <vector>

namespace coupling
{
  /** The bodies of a solid as their contact sees them, and how their vertices follow the nodes. */
  struct BodyLayers
  {
    bodies::BodyMesh                      mesh;
    std::vector<std::vector<std::size_t>> parents; ///< nodes of the solid (carriers) whose mean each vertex is
  };

  /**
   * The disconnected parts of a solid are its bodies. Their elements that have a node on the surface are divided into
   * simplices: blocks about their centre and those of their faces, simplices only where all nodes of a face inside the body lie on its
   * surface. The places added so have a depth of their own: a wedge at an edge resists as well as a face.
   *
   * Bodies are named by the material of their elements, and numbered where several have the same.
   * @param names of the materials of the bodies wanted; empty: all. @throws base::InputError for a name that no body has
   */
  template <int dim>
  BodyLayers body_layers(const fem::Solid<dim>          &solid,
                         const SolidParticipant<dim>    &participant,
                         const std::vector<std::string> &names);
} // namespace coupling
