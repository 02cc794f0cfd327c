#pragma once

#include "fem/solid/solid.h"

namespace fem
{
  /**
   * Writes the state of a solid for ParaView: displacement, reaction, stress, strain and every history variable.
   *
   * Point values are averaged to the vertices, weighted with the share of each point in the vertex; a history that a
   * neighbouring material does not have counts only where it exists. A history of one number stands there also per element,
   * as NAME_of_element: the largest of its points, so that a crack one element wide is not smeared.
   * One VTU file on one rank; on several a PVTU record and a file per rank.
   *
   * @param reaction internal less external force [N].
   * @return name of the file to open, within the folder.
   */
  template <int dim>
  std::string write_snapshot(Solid<dim>        &solid,
                             const Vector      &displacement,
                             const Vector      &reaction,
                             const std::string &folder,
                             const std::string &name,
                             unsigned int       number);
}
