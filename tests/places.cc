#include "tests/places.h"

namespace places
{
  const std::string sources = BRECCIA_SOURCE_DIR;
  const std::string program = BRECCIA_PROGRAM;
  const std::string mpirun  = BRECCIA_MPIRUN;
} // namespace places
