#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace postprocess
{
  /** The system's words for its last error (errno). */
  std::string system_reason();

  /** An open file, closed at the end of its scope; every failure is an OutputError that names the file. */
  class FileDescriptor
  {
  public:
    /** @param flags of open(2), e.g. O_WRONLY | O_CREAT | O_TRUNC. @throws OutputError. */
    FileDescriptor(const std::filesystem::path &path, int flags);
    ~FileDescriptor();
    FileDescriptor(const FileDescriptor &)            = delete;
    FileDescriptor &operator=(const FileDescriptor &) = delete;

    void write(std::string_view text);  ///< all of it; @throws OutputError
    void shorten(std::uintmax_t bytes); ///< keep the first bytes, continue after them; @throws OutputError
    void sync();                        ///< wait until the disk has it; @throws OutputError

  private:
    [[noreturn]] void fail(const char *what) const;

    std::filesystem::path path;
    int                   descriptor;
  };
} // namespace postprocess
