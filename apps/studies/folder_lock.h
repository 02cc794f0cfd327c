#pragma once

#include <filesystem>

namespace apps
{
  /**
   * Holds a folder of runs, or a part of one, for this process and its runs, which inherit it: whoever comes after waits until those of
   * one that was killed are gone, too.
   */
  class FolderLock
  {
  public:
    /** @param file in a folder of the folder that is held @throws postprocess::OutputError after five seconds */
    explicit FolderLock(const std::filesystem::path &file);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    int descriptor;
  };
} // namespace apps
