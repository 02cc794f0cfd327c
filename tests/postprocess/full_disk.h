#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace postprocess_tests
{
  /** While it lives, no file can grow beyond some bytes: writing fails as on a full disk. */
  class FullDisk
  {
  public:
    explicit FullDisk(const rlim_t bytes)
    {
      previous_handler = ::signal(SIGXFSZ, SIG_IGN); // the default would end the program
      ::getrlimit(RLIMIT_FSIZE, &previous_limit);
      rlimit limit   = previous_limit;
      limit.rlim_cur = bytes;
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk()
    {
      ::setrlimit(RLIMIT_FSIZE, &previous_limit);
      ::signal(SIGXFSZ, previous_handler);
    }
    FullDisk(const FullDisk &)            = delete;
    FullDisk &operator=(const FullDisk &) = delete;

  private:
    rlimit       previous_limit;
    sighandler_t previous_handler;
  };
} // namespace postprocess_tests
