#pragma once

#include "dem/packing/compaction.h"

#include <functional>

namespace dem
{
  /**
   * A box of equal spheres with flat faces, as a specimen out of its mould (doc/theory/packing.md, 3): a layer of spheres lies against
   * each face, where a box cut out of a cell has ragged and sparse ones.
   *
   * So many spheres are compacted between plates that these stand at the box's edges, within some thousandths; then centres are
   * spaced to where they stand exactly. Radii are the requested ones.
   *
   * @param usual what else there is to say of the packing; its count and proportions are replaced
   * @param box edges [m]
   * @param make compact(), or what has kept its results
   * @throws base::InputError if the box is narrower than one sphere, or would hold more than 1e8
   */
  Packing moulded_box(const CompactionParameters                                          &usual,
                      const Eigen::Vector3d                                               &box,
                      const std::function<CompactionResult(const CompactionParameters &)> &make);
} // namespace dem
