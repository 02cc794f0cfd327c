#pragma once

#include "apps/specimens/cache_folder.h"
#include "dem/packing/compaction.h"

#include <optional>

namespace apps
{
  /** Compacted packings, kept from run to run. */
  class PackingCache
  {
  public:
    explicit PackingCache(CacheFolder folder);

    /** The packing of these parameters as it was kept, to the last bit. */
    std::optional<dem::CompactionResult> find(const dem::CompactionParameters &parameters) const;
    void keep(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const;

    /** Where the packing of these parameters lies, or would. */
    std::filesystem::path file_of(const dem::CompactionParameters &parameters) const;

  private:
    CacheFolder folder;
  };

  /** In packing_cache_folder(), if there is one. */
  std::optional<PackingCache> packing_cache();

  /** What the first of several ranks finds in its cache, if it has one, on all of them; they may have others, or none. */
  std::optional<dem::CompactionResult> find_on_first_rank(const std::optional<PackingCache> &cache,
                                                          const dem::CompactionParameters   &parameters);
} // namespace apps
