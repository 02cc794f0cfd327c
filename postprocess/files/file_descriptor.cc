#include "postprocess/files/file_descriptor.h"

#include "postprocess/files/errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace postprocess
{
  std::string system_reason() { return std::generic_category().message(errno); }

  FileDescriptor::FileDescriptor(const std::filesystem::path &path_, const int flags)
    : path(path_)
    , descriptor(::open(path_.c_str(), flags | O_CLOEXEC, 0666))
  {
    if (descriptor < 0)
      fail("opened for writing");
  }

  FileDescriptor::~FileDescriptor() { ::close(descriptor); }

  void FileDescriptor::write(std::string_view text)
  {
    while (!text.empty())
      {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) // Ctrl-C is handled between steps, not in the middle of a row
          continue;
        if (written < 0)
          fail("written");
        text.remove_prefix(static_cast<std::size_t>(written));
      }
  }

  void FileDescriptor::shorten(const std::uintmax_t bytes)
  {
    const off_t end = static_cast<off_t>(bytes);
    if (::ftruncate(descriptor, end) != 0 || ::lseek(descriptor, end, SEEK_SET) != end)
      fail("shortened");
  }

  void FileDescriptor::sync()
  {
    const bool done = ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP; // devices and pipes have no disk
    if (!done)
      fail("brought to the disk");
  }

  void FileDescriptor::fail(const char *const what) const
  {
    throw OutputError(path.string() + ": cannot be " + what + ": " + system_reason() + ".");
  }
} // namespace postprocess
