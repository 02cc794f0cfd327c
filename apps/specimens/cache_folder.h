#pragma once

#include "postprocess/hdf5/hdf5_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace apps
{
  /**
   * Files that are kept from run to run, each named after all that determines its content, the key.
   *
   * What is damaged, of another version or of another key is as if it were not there. Writing is atomic and gives way silently: a full disk
   * or a folder that may not be written costs time, no result. The files that have not been used longest go when together they become too large.
   */
  class CacheFolder
  {
  public:
    static constexpr std::uintmax_t usual_size = std::uintmax_t(512) << 20; ///< of all files together [bytes]

    explicit CacheFolder(std::filesystem::path folder, std::uintmax_t most_bytes = usual_size);

    /** Where the file of this key lies, or would. @param kind ends its name: "packing" */
    std::filesystem::path file_of(const std::string &key, const std::string &kind) const;

    /** @param take what is in the file; false where it is not what it should be. @return whether it was taken */
    bool find(const std::string                                               &key,
              const std::string                                               &kind,
              const std::function<bool(const postprocess::hdf5::InputFile &)> &take) const;

    void keep(const std::string                                          &key,
              const std::string                                          &kind,
              const std::function<void(postprocess::hdf5::OutputFile &)> &fill) const;

  private:
    void drop_oldest() const;

    std::filesystem::path folder;
    std::uintmax_t        most_bytes;
  };

  /**
   * The user's, of packings: breccia/packings in XDG_CACHE_HOME, or in .cache of HOME (the XDG rules for base folders).
   * @return nothing where neither is set to an absolute path, or after do_without_packing_cache().
   */
  std::optional<CacheFolder> packing_cache_folder();

  /** Option --no-cache: for the rest of the program. */
  void do_without_packing_cache();
} // namespace apps
