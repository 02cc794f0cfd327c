#pragma once

#include "dem/packing/compaction.h"

namespace dem
{
  /** Spheres that are compacted in one cell where no number is given: some ten seconds on one core. */
  constexpr std::size_t most_in_one_cell = 20000;

  /**
   * The cell for a box: of the box's proportions and large enough to cut it out whole, so that nothing repeats; where that takes too
   * many spheres a cube of most_in_one_cell, to be repeated. A box smaller than the usual cell is cut out of that.
   *
   * @param usual what to do without a box; its count and proportions may be replaced
   */
  CompactionParameters cell_for_box(const CompactionParameters &usual, const Eigen::Vector3d &box);
} // namespace dem
