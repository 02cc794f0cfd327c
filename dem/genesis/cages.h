#pragma once

#include "dem/genesis/vessel.h"
#include "dem/model/packing.h"

#include <functional>

namespace dem
{
  /**
   * Give floaters the places and radii with which they touch their neighbours on all sides (doc/theory/genesis.md, 4), one after the other in the
   * order of their numbers. Where the cage is too wide, one grows by the enlargement and stays a floater.
   *
   * @param is_floater by number @param enlargement of a radius, at most [-] @param overlap with what they touch [m]
   */
  void fit_into_cages(Packing                                &packing,
                      const Vessel                           &vessel,
                      const std::function<bool(std::size_t)> &is_floater,
                      double                                  enlargement,
                      double                                  overlap);
} // namespace dem
