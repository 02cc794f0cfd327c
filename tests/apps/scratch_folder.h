#pragma once

#include <filesystem>
#include <string>

namespace apps_tests
{
  /** An empty folder for one test, removed with all it holds at the end of the scope. */
  class ScratchFolder
  {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder &)            = delete;
    ScratchFolder &operator=(const ScratchFolder &) = delete;

    const std::filesystem::path &path() const { return folder; }
    std::filesystem::path        operator/(const std::string &name) const { return folder / name; }
    /** Make a file with this content. @return its path */
    std::string file(const std::string &name, const std::string &content) const;

  private:
    std::filesystem::path folder;
  };

  std::string content_of(const std::filesystem::path &file);
  /** Relative names and contents of all files in a folder, as one text: equal texts, equal folders. */
  std::string listing_of(const std::filesystem::path &folder);
} // namespace apps_tests
