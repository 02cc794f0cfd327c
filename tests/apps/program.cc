#include "tests/apps/program.h"

#include "apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <fcntl.h>
#include <omp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>

namespace apps_tests
{
  namespace
  {
    /** A file beside the test's own, so that what the program says does not show up among its results. */
    std::filesystem::path transcript(const std::filesystem::path &folder, const char *stream)
    {
      static std::atomic<int> number{0};
      return folder.string() + "." + std::to_string(++number) + "." + stream;
    }

    void redirect(const std::filesystem::path &file, const int stream)
    {
      const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (descriptor < 0 || dup2(descriptor, stream) < 0)
        _exit(120);
    }

    std::string taken(const std::filesystem::path &file)
    {
      std::string content = content_of(file);
      std::filesystem::remove(file);
      return content;
    }

    /** What a program inherits, once, when its libraries are loaded. */
    struct Surroundings
    {
      std::vector<std::string> environment;
      int                      threads = omp_get_max_threads();

      Surroundings()
      {
        for (char **entry = environ; *entry; ++entry)
          if (std::string(*entry).rfind("XDG_", 0) != 0) // which the program reads each time it needs it
            environment.emplace_back(*entry);
      }
      bool operator==(const Surroundings &other) const
      {
        return environment == other.environment && threads == other.threads;
      }
    };
    const Surroundings at_the_start;

    /** A copy of this process is then as good as the program loaded anew, which takes half a second. */
    bool is_as_at_the_start()
    {
      const std::filesystem::directory_iterator threads("/proc/self/task");
      return std::distance(begin(threads), end(threads)) == 1 && Surroundings() == at_the_start;
    }

    /** In a copy of this process: forget what the tests have set up in it, and be the program. */
    [[noreturn]] void be_the_program(std::vector<char *> &argv)
    {
      for (int signal = 1; signal < NSIG; ++signal)
        std::signal(signal, SIG_DFL);
      setenv("OMP_WAIT_POLICY", "passive", 0); // else it would start itself again with it, which is the tests here
      std::exit(apps::run_program(static_cast<int>(argv.size()) - 1, argv.data()));
    }
  } // namespace

  Program::Program(const std::filesystem::path    &folder,
                   const std::vector<std::string> &arguments,
                   const long                      largest_file,
                   const Start                     start)
    : out(transcript(folder, "out"))
    , err(transcript(folder, "err"))
  {
    std::vector<std::string> words = {places::program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);

    std::cout.flush(); // or a copy would say once more what is still to be said
    std::fflush(nullptr);
    process = fork();
    if (process < 0)
      throw std::runtime_error("the program could not be started");
    if (process > 0)
      return;
    prctl(PR_SET_PDEATHSIG, SIGKILL); // a test that is stopped leaves no run behind
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (largest_file > 0)
      {
        const auto   bytes = static_cast<rlim_t>(largest_file);
        const rlimit limit = {bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
    if (chdir(folder.c_str()) != 0)
      _exit(121);
    if (start == Start::copied)
      be_the_program(argv);
    execv(places::program().c_str(), argv.data());
    _exit(121);
  }

  Program::~Program()
  {
    if (!ended)
      {
        send(SIGKILL);
        wait();
      }
  }

  bool Program::running()
  {
    if (!ended)
      ended = waitpid(process, &status, WNOHANG) == process;
    return !ended;
  }

  bool Program::catches(const int signal) const
  {
    std::ifstream status_of_process("/proc/" + std::to_string(process) + "/status");
    for (std::string word; status_of_process >> word;)
      if (word == "SigCgt:")
        {
          unsigned long long caught = 0;
          status_of_process >> std::hex >> caught;
          return (caught >> (signal - 1) & 1) == 1;
        }
    return false;
  }

  void Program::send(const int signal) { kill(process, signal); }

  Outcome Program::wait()
  {
    if (!ended)
      waitpid(process, &status, 0);
    ended = true;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), taken(out), taken(err)};
  }

  Outcome run(const std::filesystem::path &folder, const std::vector<std::string> &arguments, const long largest_file)
  {
    const auto start = is_as_at_the_start() ? Program::Start::copied : Program::Start::anew;
    return Program(folder, arguments, largest_file, start).wait();
  }
} // namespace apps_tests
