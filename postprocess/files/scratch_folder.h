#pragma once

#include <filesystem>
#include <string>

namespace postprocess
{
  /** A folder of its own among the system's temporary files, removed with all it holds at the end of the scope. */
  class ScratchFolder
  {
  public:
    /** @param purpose part of its name: breccia-PURPOSE-... @throws OutputError */
    explicit ScratchFolder(const std::string &purpose);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder &)            = delete;
    ScratchFolder &operator=(const ScratchFolder &) = delete;

    /** Make a file with this content. @throws OutputError */
    void write(const std::string &name, const std::string &text) const;

    const std::filesystem::path &path() const { return folder; }
    std::filesystem::path        operator/(const std::string &name) const { return folder / name; }

  private:
    std::filesystem::path folder;
  };
} // namespace postprocess
