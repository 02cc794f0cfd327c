#include "apps/studies/folder_lock.h"

#include "postprocess/files/errors.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace apps
{
  FolderLock::FolderLock(const std::filesystem::path &file)
    : descriptor(open(file.c_str(), O_RDWR | O_CREAT, 0666)) // inherited on purpose
  {
    constexpr int most_attempts = 100; // five seconds
    if (descriptor < 0)
      throw postprocess::OutputError(file.string() + ": cannot be opened: " + std::strerror(errno) + ".");
    for (int attempt = 0; flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++attempt)
      {
        if (attempt == most_attempts)
          {
            close(descriptor);
            throw postprocess::OutputError(file.parent_path().parent_path().string() +
                                           ": another process works on this study, or on this part of it.");
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
  }

  FolderLock::~FolderLock() { close(descriptor); }
} // namespace apps
