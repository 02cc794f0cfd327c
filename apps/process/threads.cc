#include "apps/process/threads.h"

#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace apps
{
  namespace
  {
    int left_to_others = 0; ///< processors, because they were busy

    /** Ticks of the clock so far, summed over the processors that this process may use. */
    struct Ticks
    {
      double idle = 0, all = 0;
    };

    /** From /proc/stat; all = 0 where there is none. */
    Ticks ticks_now()
    {
      cpu_set_t allowed;
      CPU_ZERO(&allowed);
      if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0)
        return {};
      Ticks         sum;
      std::ifstream stat("/proc/stat");
      for (std::string line; std::getline(stat, line);)
        {
          std::istringstream fields(line);
          std::string        name;
          fields >> name;
          if (name.compare(0, 3, "cpu") != 0 || name.size() == 3 || !CPU_ISSET(std::atoi(name.c_str() + 3), &allowed))
            continue;
          // user, nice, system, idle, waiting for the disk, interrupts (2), taken by the host
          double value = 0;
          for (int column = 0; column < 8 && fields >> value; ++column)
            {
              sum.all += value;
              sum.idle += column == 3 || column == 4 ? value : 0;
            }
        }
      return sum;
    }

    /** Processors with nothing to do, out of so many: the most of a few samples, so that a short burst does not count. */
    double idle_processors(const int processors)
    {
      if (processors == 1)
        return 1;
      constexpr int                       samples = 3;
      constexpr std::chrono::milliseconds interval{100};
      double                              most = 0;
      for (int i = 0; i < samples && most < processors - 0.5; ++i)
        {
          const Ticks before = ticks_now();
          std::this_thread::sleep_for(interval);
          const Ticks after = ticks_now();
          if (!(after.all > before.all))
            return processors; // nothing can be known here
          most = std::max(most, processors * (after.idle - before.idle) / (after.all - before.all));
        }
      return most;
    }
    /** The words of the command line that started this process. */
    std::vector<std::string> command_line()
    {
      std::ifstream            file("/proc/self/cmdline");
      std::vector<std::string> words;
      for (std::string word; std::getline(file, word, '\0');)
        words.push_back(word);
      return words;
    }

    void let_waiting_threads_sleep(const int threads)
    {
      constexpr const char *spins = "GOMP_SPINCOUNT";
      if (threads < 2 || std::getenv(spins) || std::getenv("OMP_WAIT_POLICY") || setenv(spins, "1000", 0) != 0)
        return;
      std::vector<std::string> words = command_line();
      std::vector<char *>      argv;
      for (std::string &word : words)
        argv.push_back(word.data());
      argv.push_back(nullptr);
      setenv("OMP_NUM_THREADS", std::to_string(threads).c_str(), 1);
      // Under its own name, by which `top` and `pkill` know it. It returns only where that is impossible: a run is then slower
      // beside others.
      std::error_code             ignored;
      const std::filesystem::path itself = "/proc/self/exe", file = std::filesystem::read_symlink(itself, ignored);
      execv(file.c_str(), argv.data());
      execv(itself.c_str(), argv.data());
    }
  } // namespace

  std::string threads_in_words()
  {
    return left_to_others == 0 ? "" :
                                 fmt::format(", on {} of {} processors, as {} busy (--threads for more)",
                                             omp_get_num_procs() - left_to_others, omp_get_num_procs(),
                                             left_to_others == 1 ? "one is" : "others are");
  }

  void use_threads(const int requested)
  {
    const int processors = omp_get_num_procs();
    int       threads    = requested > 0 ? requested : omp_get_max_threads();
    if (requested == 0 && !std::getenv("OMP_NUM_THREADS") && launched_ranks() == 1)
      {
        threads        = std::clamp(static_cast<int>(std::floor(idle_processors(processors) + 0.5)), 1, processors);
        left_to_others = processors - threads;
      }
    let_waiting_threads_sleep(threads);
    omp_set_num_threads(threads);
  }
} // namespace apps
