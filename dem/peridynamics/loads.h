#pragma once

#include "dem/peridynamics/supports.h"

#include <functional>

namespace dem::peridynamics
{
  /** What acts on a body. Both functions take a load factor, or a time [s]. */
  struct Loads
  {
    /** Add the forces [N]. @param u displacement by which tractions turn; nullptr: those of the body at rest */
    std::function<void(double at, const Field *u, Field &forces)> forces;
    /** Set the displacement [m] of the components that are held. */
    std::function<void(double at, Field &u)> displacements;
    Held                                     held;
  };
} // namespace dem::peridynamics
