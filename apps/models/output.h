#pragma once

#include <cstdint>

namespace apps
{
  /** What a snapshot of particles is written to: one file by the first rank, or a piece by each of them. */
  enum class SnapshotPieces
  {
    one,
    per_rank
  };

  /** Section "Output": how often results are written. */
  struct OutputSection
  {
    std::int64_t   samples   = 500; ///< smooth curves; a sample costs about as much as one time step
    std::int64_t   snapshots = 20;  ///< enough to see a crack grow; a few megabytes each for ten thousand particles
    SnapshotPieces pieces    = SnapshotPieces::one; ///< of particles and links, where ranks may share them
    double         checkpoint_interval = 600;       ///< [s] wall clock: at most ten minutes of work can be lost
  };
} // namespace apps
