#pragma once

#include "apps/models/genesis.h"

namespace apps
{
  class Section;

  void declare(Section &genesis, AggregatesSection &aggregates);
  /** @param chosen whether the scene has chosen it */
  void declare(Section &specimen, GenesisSection &genesis, const int &dimension, const std::function<bool()> &chosen);
} // namespace apps
