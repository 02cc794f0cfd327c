#include "postprocess/files/atomic_file.h"

#include "postprocess/files/errors.h"
#include "postprocess/files/file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace postprocess
{
  namespace
  {
    namespace fs = std::filesystem;

    /** The file itself, where the path is a symbolic link. */
    fs::path followed(const fs::path &path)
    {
      std::error_code ignored; // a link to nowhere: its own path then names the file to make
      return fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    }

    bool is_device_or_pipe(const fs::path &path)
    {
      std::error_code       ignored;
      const fs::file_status status = fs::status(path, ignored);
      return fs::is_character_file(status) || fs::is_fifo(status) || fs::is_socket(status) || fs::is_block_file(status);
    }

    fs::path folder_of(const fs::path &path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }
  } // namespace

  AtomicFile::AtomicFile(const fs::path &destination)
    : destination_path(followed(destination))
  {
    partial_path = destination_path;
    partial_path += ".partial";

    std::error_code       ignored;
    const fs::file_status status = fs::status(destination_path, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status))
      throw OutputError(destination.string() + ": is a folder or device, not a file that could be replaced.");
    if (fs::exists(status) && ::access(destination_path.c_str(), W_OK) != 0)
      throw OutputError(destination.string() + ": is write-protected: " + system_reason() + ".");
    if (!fs::is_directory(folder_of(destination_path), ignored))
      throw OutputError(destination.string() + ": the folder " + folder_of(destination_path).string() +
                        " does not exist.");
    FileDescriptor(partial_path, O_WRONLY | O_CREAT | O_TRUNC); // so that the reason why not is the system's own
  }

  AtomicFile::~AtomicFile()
  {
    std::error_code ignored;
    if (!committed)
      fs::remove(partial_path, ignored);
  }

  void AtomicFile::commit()
  {
    FileDescriptor(partial_path, O_WRONLY).sync();
    std::error_code error;
    fs::rename(partial_path, destination_path, error);
    if (error)
      throw OutputError(destination_path.string() + ": cannot be replaced: " + error.message() + ".");
    committed = true;
    FileDescriptor(folder_of(destination_path), O_RDONLY | O_DIRECTORY).sync(); // the new name, too
  }

  void write_text(const fs::path &destination, const std::string_view text)
  {
    // By its name alone: where a shell sends it into a file, that file must be written on, not replaced.
    if (destination == "/dev/stdout")
      {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
          throw OutputError("standard output: cannot be written: " + system_reason() + ".");
        return;
      }
    if (is_device_or_pipe(destination))
      {
        FileDescriptor(destination, O_WRONLY).write(text);
        return;
      }
    AtomicFile target(destination);
    FileDescriptor(target.partial(), O_WRONLY | O_TRUNC).write(text);
    target.commit();
  }
} // namespace postprocess
