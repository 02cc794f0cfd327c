#pragma once

#include "apps/specimens/cache_folder.h"
#include "base/column.h"
#include "dem/genesis/genesis.h"

#include <optional>

namespace apps
{
  /** Grown packings, kept from run to run: the state of their genesis at its end. */
  class GenesisCache
  {
  public:
    explicit GenesisCache(CacheFolder folder);

    /** State of a genesis of these parameters at its end, as it was kept. */
    std::optional<base::Column> find(const dem::GenesisParameters &parameters) const;
    /** @pre it has finished */
    void keep(dem::Genesis &genesis, const dem::GenesisParameters &parameters) const;
    /** Whether one of these parameters is kept, undamaged. */
    bool has(const dem::GenesisParameters &parameters) const;

    /** Where that of these parameters lies, or would. */
    std::filesystem::path file_of(const dem::GenesisParameters &parameters) const;

  private:
    CacheFolder folder;
  };

  /** In packing_cache_folder(), if there is one. */
  std::optional<GenesisCache> genesis_cache();

  /**
   * Put a genesis of these parameters to its end, to the last bit as the cache has kept it: that of the first of several ranks, which all call this;
   * they may have others, or none. @return false: it is not kept, nothing has changed
   */
  bool finish_as_kept(const std::optional<GenesisCache> &cache,
                      dem::Genesis                      &genesis,
                      const dem::GenesisParameters      &parameters);
} // namespace apps
