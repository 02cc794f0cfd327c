#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** How a process ended. */
  struct EndedChild
  {
    long   job;
    int    status; ///< exit status; 128 + signal if a signal ended it
    double seconds;
  };

  /** What the system could still give [bytes]; the most there can be where it does not say. */
  std::uint64_t available_memory();

  /**
   * Processes of this program that run scenes, several at a time. They are killed with the process that started them, however it ends
   * (Linux).
   */
  class ChildRuns
  {
  public:
    /** @param most at a time @param available says how much memory could still be taken [bytes] */
    explicit ChildRuns(int most, std::function<std::uint64_t()> available = available_memory);
    ~ChildRuns(); ///< kills those that still run
    ChildRuns(const ChildRuns &)            = delete;
    ChildRuns &operator=(const ChildRuns &) = delete;

    /** Whether one more has a processor, and as much free memory as the largest so far took. */
    bool has_room() const;
    bool idle() const { return running.empty(); }

    /** Start the program with these words; what it prints goes to the file. @throws std::runtime_error */
    void start(long job, const std::vector<std::string> &words, const std::filesystem::path &log);

    /** Request that all save their state and end, and wait until they have. */
    void interrupt();

    /** One that has ended; nothing where none has within the time. */
    std::optional<EndedChild> wait(std::chrono::milliseconds patience);

  private:
    using Clock = std::chrono::steady_clock;
    struct Child
    {
      long              job;
      Clock::time_point start;
    };

    int                            most;
    std::function<std::uint64_t()> available;
    std::map<pid_t, Child>         running;
    std::uint64_t                  largest_memory = 0; ///< [bytes]
  };

  /** What the program said when it gave up: the last line of its log that begins with its name, or how it ended. */
  std::string last_words(const std::filesystem::path &log, int status);

  /** How many of the runs that are left go on at a time, and how many threads each has. */
  struct SharedThreads
  {
    int runs = 1, threads = 1;
  };
  SharedThreads shared_threads(int threads, std::int64_t left);

  /**
   * Processors that too few runs are left for go to those that are, where they last long enough for threads to pay.
   * @param together runs that there are processors for @param threads of each of these
   * @param left runs that have not ended @param seconds that the longest so far took
   */
  int threads_of_a_run(int together, int threads, std::int64_t left, double seconds);

  /** Processors that this process may use. */
  int usable_processors();
} // namespace apps
