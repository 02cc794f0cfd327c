#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace apps_tests
{
  /** How the program ended and what it said. */
  struct Outcome
  {
    int         status; ///< exit status; 128 + signal if a signal ended it
    std::string out, err;
  };

  /** The built program `breccia`, running in a folder of its own choice. */
  class Program
  {
  public:
    enum class Start
    {
      anew,  ///< from its file
      copied ///< a copy of this process, which has its libraries loaded, does what main does
    };
    /** Start it. @param largest_file bytes beyond which writing fails, as on a full disk; 0: no limit */
    Program(const std::filesystem::path    &folder,
            const std::vector<std::string> &arguments,
            long                            largest_file = 0,
            Start                           start        = Start::anew);
    ~Program(); ///< kills it if it still runs
    Program(const Program &)            = delete;
    Program &operator=(const Program &) = delete;

    bool    running();
    bool    catches(int signal) const; ///< it has set a handler of its own for the signal
    void    send(int signal);
    Outcome wait();

  private:
    std::filesystem::path out, err;
    pid_t                 process;
    bool                  ended  = false;
    int                   status = 0;
  };

  /** Start it, as a copy where that makes no difference, and wait for its end. */
  Outcome run(const std::filesystem::path &folder, const std::vector<std::string> &arguments, long largest_file = 0);
} // namespace apps_tests
