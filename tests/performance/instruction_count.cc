#include "instruction_count.h"

#include <csignal>

#ifdef __linux__
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace performance
{
#ifdef __linux__
  namespace
  {
    [[noreturn]] void work_between_stops(const std::function<void()> &work)
    {
      if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0)
        _exit(1);
      raise(SIGSTOP);
      work();
      raise(SIGSTOP);
      _exit(0);
    }

    bool stopped_by(const pid_t child, const int signal)
    {
      int status = 0;
      return waitpid(child, &status, 0) == child && WIFSTOPPED(status) && WSTOPSIG(status) == signal;
    }
  } // namespace

  double instructions_of(const std::function<void()> &work)
  {
    const pid_t child = fork();
    if (child == 0)
      work_between_stops(work);
    double count = 0;
    if (child > 0 && stopped_by(child, SIGSTOP))
      {
        const auto step = [child] { return ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) == 0; };
        while (step() && stopped_by(child, SIGTRAP))
          ++count;
        ptrace(PTRACE_KILL, child, nullptr, nullptr);
      }
    if (child > 0)
      {
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
      }
    return count;
  }
#else
  double instructions_of(const std::function<void()> &) { return 0; }
#endif
} // namespace performance
