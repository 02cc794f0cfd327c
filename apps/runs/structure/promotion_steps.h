#pragma once

#include "dem/statics/quasi_static_path.h"
#include "postprocess/files/csv_table.h"

#include <optional>
#include <vector>

namespace apps
{
  /** The point of a path at which elements became particles and the force changed most, at a held load factor. */
  struct PromotionStep
  {
    double change;      ///< of the force of the load factor, over the force before [-]; below zero: it fell
    double load_factor; ///< [-]
  };

  /**
   * @param series rows of the path, from its first point after the start @param points of the path, the start included
   * @return nothing where no element became particles under a force
   */
  std::optional<PromotionStep> largest_promotion_step(const postprocess::CsvTable              &series,
                                                      const std::vector<dem::QuasiStaticPoint> &points);
} // namespace apps
