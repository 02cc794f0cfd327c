#pragma once

#include "dem/packing/compaction.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace apps
{
  /**
   * Generated packings, kept from run to run: a file each, named after all that determines the packing.
   *
   * What is damaged, of another version or of other parameters is as if it were not there. Writing is atomic and gives way
   * silently: a full disk or a folder that may not be written costs time, no result. The packings that have not been used
   * longest go when together they become too large.
   */
  class PackingCache
  {
  public:
    static constexpr std::uintmax_t usual_size = std::uintmax_t(512) << 20; ///< of all files together [bytes]

    explicit PackingCache(std::filesystem::path folder, std::uintmax_t most_bytes = usual_size);

    /** The packing of these parameters as it was kept, to the last bit. */
    std::optional<dem::CompactionResult> find(const dem::CompactionParameters &parameters) const;
    void keep(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const;

    /** Where the packing of these parameters lies, or would. */
    std::filesystem::path file_of(const dem::CompactionParameters &parameters) const;

  private:
    void write(const dem::CompactionParameters &parameters, const dem::CompactionResult &result) const;
    void drop_oldest() const;

    std::filesystem::path folder;
    std::uintmax_t        most_bytes;
  };

  /**
   * The user's: breccia/packings in XDG_CACHE_HOME, or in .cache of HOME (the XDG rules for base folders).
   * @return nothing where neither is set to an absolute path, or after do_without_packing_cache().
   */
  std::optional<PackingCache> packing_cache();

  /** Option --no-cache: for the rest of the program. */
  void do_without_packing_cache();
} // namespace apps
