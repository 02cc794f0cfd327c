#pragma once

#include "apps/runs/continuum/solid.h"
#include "apps/runs/coupled/handshakes.h"

namespace apps
{
  /** What particles inside a solid have of its place. @param handshakes must outlive it */
  TakenPlaces taken_by(const HandshakesSection &handshakes);
} // namespace apps
