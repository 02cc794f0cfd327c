#pragma once

#include "dem/packing/compaction.h"

namespace dem
{
  class Ranks;

  /**
   * compact() by several ranks, which all call it and all have the packing of one, to the last bit (doc/theory/packing.md, 1).
   *
   * @param ranks null: this process alone @param progress called on all of them; must return the same on all
   * @throws as compact(), on all ranks
   */
  CompactionResult compact_on(Ranks                                                 *ranks,
                              const CompactionParameters                            &parameters,
                              const std::function<bool(const CompactionProgress &)> &progress = {});
} // namespace dem
