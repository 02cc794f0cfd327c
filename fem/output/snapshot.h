#pragma once

#include "fem/output/solid_snapshot.h"
#include "fem/solid/solid.h"

namespace fem
{
  /**
   * What a viewer is shown of a solid; on several ranks each takes what it owns, and all have the same fields.
   *
   * At nodes: displacement, reaction, and averages of stress, strain and every history of six numbers over the points around, weighted
   * with the share of each point in the node; a history that a neighbouring material does not have counts only where it exists. Of
   * elements: every history of one number, the largest of the element's points, so that a crack one element wide is not smeared.
   *
   * @param reaction internal less external force [N].
   */
  template <int dim>
  SolidSnapshot take_snapshot(Solid<dim> &solid, const Vector &displacement, const Vector &reaction);
}
