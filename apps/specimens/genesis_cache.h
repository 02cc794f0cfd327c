#pragma once

#include "apps/specimens/cache_folder.h"
#include "dem/genesis/genesis.h"

#include <optional>

namespace apps
{
  /** Grown packings, kept from run to run: the state of their genesis at its end. */
  class GenesisCache
  {
  public:
    explicit GenesisCache(CacheFolder folder);

    /** Put a genesis of these parameters to its end, to the last bit as it was kept. @return false: it is not kept, nothing has changed */
    bool finish(dem::Genesis &genesis, const dem::GenesisParameters &parameters) const;
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
} // namespace apps
