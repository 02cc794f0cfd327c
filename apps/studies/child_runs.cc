#include "apps/studies/child_runs.h"

#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace apps
{
  namespace
  {
    constexpr auto between_looks = std::chrono::milliseconds(5);

    int status_of(const int waited)
    {
      return WIFEXITED(waited) ? WEXITSTATUS(waited) : 128 + (WIFSIGNALED(waited) ? WTERMSIG(waited) : 0);
    }

    /** That of this process, without what says that mpirun has started it: a run is a process of its own. */
    std::vector<char *> environment_of_a_run()
    {
      std::vector<char *> kept;
      for (char **variable = environ; *variable; ++variable)
        {
          const std::string_view text(*variable);
          const auto begins = [text](const std::string_view prefix) { return text.substr(0, prefix.size()) == prefix; };
          if (!begins("OMPI_") && !begins("PMIX_") && !begins("PMI_") && !begins("PRTE_"))
            kept.push_back(*variable);
        }
      kept.push_back(nullptr);
      return kept;
    }

    /** In the new process: nothing but calls that are safe between fork and exec. */
    [[noreturn]] void become(const pid_t parent, const int log, char *const words[], char *const environment[])
    {
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) // it was gone before
        _exit(127);
#else
      static_cast<void>(parent);
#endif
      setpgid(0, 0); // Ctrl-C on the terminal is for the study, which decides
      const int nothing = open("/dev/null", O_RDONLY);
      if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0)
        _exit(127);
      execve("/proc/self/exe", words, environment);
      _exit(127);
    }
  } // namespace

  std::uint64_t available_memory()
  {
    std::ifstream file("/proc/meminfo");
    std::string   name, unit;
    for (std::uint64_t kilobytes; file >> name >> kilobytes && std::getline(file, unit);)
      if (name == "MemAvailable:")
        return kilobytes << 10;
    return UINT64_MAX;
  }

  std::string last_words(const std::filesystem::path &log, const int status)
  {
    constexpr std::string_view name = "breccia: ";
    const std::string          text = postprocess::numeric_text::read_whole(log);
    std::string                said;
    for (postprocess::numeric_text::Lines lines(text); lines.next();)
      if (lines.text().substr(0, name.size()) == name)
        said = std::string(lines.text().substr(name.size()));
    if (!said.empty())
      return said;
    return status > 128 ? fmt::format("ended by signal {}", status - 128) : fmt::format("exit status {}", status);
  }

  SharedThreads shared_threads(const int threads, const std::int64_t left)
  {
    SharedThreads shared;
    shared.runs    = static_cast<int>(std::min<std::int64_t>(std::max(threads, 1), left));
    shared.threads = std::max(1, threads / shared.runs);
    return shared;
  }

  int threads_of_a_run(const int together, const int threads, const std::int64_t left, const double seconds)
  {
    constexpr double worth_threads = 10;
    return seconds < worth_threads ? threads : threads * shared_threads(together, left).threads;
  }

  int usable_processors()
  {
#ifdef __linux__
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
      return std::max(1, CPU_COUNT(&set));
#endif
    return std::max(1u, std::thread::hardware_concurrency());
  }

  ChildRuns::ChildRuns(const int most_, std::function<std::uint64_t()> available_)
    : most(std::max(most_, 1))
    , available(std::move(available_))
  {
  }

  ChildRuns::~ChildRuns()
  {
    for (const auto &[process, child] : running)
      kill(process, SIGKILL);
    for (const auto &[process, child] : running)
      waitpid(process, nullptr, 0);
  }

  bool ChildRuns::has_room() const
  {
    if (running.empty())
      return true;
    return static_cast<int>(running.size()) < most && largest_memory < available();
  }

  void ChildRuns::start(const long job, const std::vector<std::string> &words, const std::filesystem::path &log)
  {
    std::vector<std::string> all = words;
    all.insert(all.begin(), "breccia");
    std::vector<char *> pointers;
    for (std::string &word : all)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
      throw std::system_error(errno, std::generic_category(), log.string());
    const std::vector<char *> environment = environment_of_a_run();
    const pid_t               parent      = getpid();
    const pid_t               process     = fork();
    if (process == 0)
      become(parent, file, pointers.data(), environment.data());
    const int problem = errno;
    close(file);
    if (process < 0)
      throw std::system_error(problem, std::generic_category(), "a run cannot be started");
    running[process] = {job, Clock::now()};
  }

  void ChildRuns::interrupt()
  {
    for (const auto &[process, child] : running)
      kill(process, SIGINT);
    for (const auto &[process, child] : running)
      waitpid(process, nullptr, 0);
    running.clear();
  }

  std::optional<EndedChild> ChildRuns::wait(const std::chrono::milliseconds patience)
  {
    const auto until = Clock::now() + patience;
    do
      {
        for (auto child = running.begin(); child != running.end(); ++child)
          {
            int    waited = 0;
            rusage used   = {};
            if (wait4(child->first, &waited, WNOHANG, &used) != child->first)
              continue;
            largest_memory = std::max<std::uint64_t>(largest_memory, std::uint64_t(used.ru_maxrss) << 10);
            const std::chrono::duration<double> took = Clock::now() - child->second.start;
            const EndedChild                    ended{child->second.job, status_of(waited), took.count()};
            running.erase(child);
            return ended;
          }
        std::this_thread::sleep_for(between_looks);
      }
    while (Clock::now() < until);
    return std::nullopt;
  }
} // namespace apps
