#pragma once

#include <filesystem>
#include <string_view>

namespace postprocess
{
  /**
   * A file that appears complete or not at all: written beside its destination, then renamed over it.
   *
   * A program killed half-way, or a full disk, leaves the earlier file as it was. A symbolic link is followed.
   */
  class AtomicFile
  {
  public:
    /**
     * Prepare to replace `destination`; its folder must exist. Nothing is created yet.
     * @throws OutputError when the folder is missing or not writable, or the destination is not a regular file.
     */
    explicit AtomicFile(const std::filesystem::path &destination);
    /** Removes the partial file, unless committed. */
    ~AtomicFile();
    AtomicFile(const AtomicFile &)            = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /** Where to write: in the folder of the destination, named "NAME.partial". */
    const std::filesystem::path &partial() const { return partial_path; }

    /** Bring the closed partial file to the disk and rename it. @throws OutputError with the system's reason. */
    void commit();

  private:
    std::filesystem::path destination_path, partial_path;
    bool                  committed = false;
  };

  /**
   * Replace a text file atomically. A destination that is a device or a pipe (/dev/stdout) is written to directly.
   * @throws OutputError, see AtomicFile.
   */
  void write_text(const std::filesystem::path &destination, std::string_view text);
} // namespace postprocess
