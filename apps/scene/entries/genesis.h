#pragma once

#include "apps/models/genesis.h"

namespace apps
{
  class Section;

  void declare(Section &genesis, AggregatesSection &aggregates);
  /** @param chosen whether the scene has chosen it @param rigid_bodies whether the scene can move polygons of particles */
  void declare(Section &specimen, GenesisSection &genesis, const std::function<bool()> &chosen, bool rigid_bodies);
} // namespace apps
