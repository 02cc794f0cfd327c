#pragma once

#include "apps/runs/coupled/handshakes.h"

namespace apps
{
  class Section;

  /**
   * @param around the particles, outlives this @param moves whether both sides are in motion, or driven along equilibria, where particles are
   * constrained unless a scene says otherwise
   */
  void declare(Section &section, HandshakeSection &handshake, const ContinuumModel &around, bool moves);
  /** @param around, moves as above */
  void declare(Section &root, HandshakesSection &handshakes, const ContinuumModel &around, bool moves = true);
} // namespace apps
