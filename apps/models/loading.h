#pragma once

#include "apps/models/grips.h"
#include "base/entry_path.h"
#include "dem/loading/uniaxial.h"

#include <vector>

namespace apps
{
  enum class UniaxialLoad
  {
    tension,
    compression
  };

  /** "tension" or "compression": the word of scenes, files and messages. */
  const char *name_of(UniaxialLoad load);

  /** Section "Loading": uniaxial tests between two grips, each on a fresh specimen (doc/theory/laboratory-test.md). */
  struct UniaxialLoadingSection
  {
    struct Test
    {
      double rate          = 0; ///< [1/s], magnitude
      double stop_fraction = 0; ///< of the peak stress
      double stop_strain   = 0; ///< magnitude
    };

    std::vector<UniaxialLoad> tests = {UniaxialLoad::tension, UniaxialLoad::compression};
    int                       axis  = 2;
    GripEntries               grips;
    bool                      lateral_blocked = false, spin_blocked = false, grips_turn = false;
    Test                      tension, compression;

    UniaxialLoadingSection();
    void check(const base::EntryPath &root, int dimension) const;
    bool asks_for(UniaxialLoad load) const;
    /** The test as dem runs it: the rate with its sign. */
    dem::UniaxialParameters parameters(UniaxialLoad load) const;
  };
} // namespace apps
