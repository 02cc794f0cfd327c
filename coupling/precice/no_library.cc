#include "coupling/precice/library.h"

namespace coupling
{
  JoinPrecice precice_library() { return {}; }
} // namespace coupling
