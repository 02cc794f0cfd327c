#pragma once

#include <cstdint>

namespace apps
{
  /** Section "Output": how often results are written. */
  struct OutputSection
  {
    std::int64_t samples   = 500; ///< smooth curves; a sample costs about as much as one time step
    std::int64_t snapshots = 20;  ///< enough to see a crack grow; a few megabytes each for ten thousand particles
    double       checkpoint_interval = 600; ///< [s] wall clock: at most ten minutes of work can be lost
  };
} // namespace apps
