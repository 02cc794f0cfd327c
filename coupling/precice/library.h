#pragma once

#include "coupling/precice/interface.h"

namespace coupling
{
  /** Joins by the library of preCICE, whose errors become base::InputError; empty where this was built without it. */
  JoinPrecice precice_library();
} // namespace coupling
