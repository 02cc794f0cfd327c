#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <sstream>
#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  using Clock = std::chrono::steady_clock;

  double seconds_since(const Clock::time_point &start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  void wait_seconds(const double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

  /** What became of work in a process of its own, to which SIGTERM was sent as soon as it had begun. */
  struct Interrupted
  {
    int         status;
    double      seconds; ///< from the signal to the end
    std::string said;
  };

  Interrupted interrupted_work(const std::function<void()> &work)
  {
    int said[2], begun[2];
    REQUIRE(pipe(said) == 0);
    REQUIRE(pipe(begun) == 0);
    const pid_t process = fork();
    if (process == 0)
      {
        dup2(said[1], STDERR_FILENO);
        apps::catch_interrupts();
        apps::set_last_words("the state of noon is kept");
        close(begun[1]);
        work();
        _exit(7);
      }
    close(begun[1]);
    close(said[1]);
    char byte;
    REQUIRE(read(begun[0], &byte, 1) == 0); // its end was closed
    const auto start = Clock::now();
    kill(process, SIGTERM);
    int status = 0;
    waitpid(process, &status, 0);
    Interrupted outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), seconds_since(start), ""};
    while (read(said[0], &byte, 1) == 1)
      outcome.said += byte;
    close(said[0]);
    close(begun[0]);
    return outcome;
  }

  /** The program is requested to stop in the middle of something long, and ends within five seconds. */
  void stops_within_five_seconds(const ScratchFolder &folder, const std::vector<std::string> &arguments)
  {
    INFO(arguments.front());
    Program program(folder.path(), arguments);
    while (program.running() && !program.catches(SIGTERM))
      wait_seconds(0.01);
    wait_seconds(2);
    REQUIRE(program.running());
    const auto start = Clock::now();
    program.send(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(outcome.status == 130);
    CHECK_THAT(outcome.err, Contains("interrupted"));
    CHECK(seconds_since(start) < 5);
  }
} // namespace

TEST_CASE("Work that never checks whether to stop is left within five seconds, with a last message", "[apps][slow]")
{
  const Interrupted outcome = interrupted_work([] { wait_seconds(60); });
  CHECK(outcome.status == apps::exit_interrupted);
  CHECK(outcome.seconds < 5);
  CHECK(outcome.said == "\nbreccia: the state of noon is kept\n");
}

TEST_CASE("An interrupt that is being answered gets the time it takes", "[apps][slow]")
{
  const Interrupted outcome = interrupted_work([] {
    while (!apps::interrupted())
      wait_seconds(0.01);
    const apps::AnsweringInterrupt answering;
    wait_seconds(6);
  });
  CHECK(outcome.status == 7);
  CHECK(outcome.said.empty());
}

TEST_CASE("A signal is answered within five seconds while a packing is made", "[apps][slow]")
{
  const ScratchFolder folder;
  stops_within_five_seconds(folder, {"pack", "--radius", "1e-3", "--count", "300000", "-o", "p.h5"});
}

TEST_CASE("A signal is answered within five seconds while a stiffness is factorised", "[apps][slow]")
{
  const ScratchFolder folder;
  SECTION("of links")
  {
    std::ostringstream packing;
    packing << "# periodic_cell 0.06 0.06 0.06\n";
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j < 30; ++j)
        for (int k = 0; k < 30; ++k)
          packing << 2e-3 * i << ' ' << 2e-3 * j << ' ' << 2e-3 * k << " 1e-3\n";
    folder.file("p.txt", packing.str());
    stops_within_five_seconds(folder, {"homogenise", "p.txt", "--interaction-ratio", "1.5", "--normal-modulus", "25e9",
                                       "--shear-ratio", "0.2", "--solver", "direct"});
  }
  SECTION("of elements")
  {
    folder.file("x.prm",
                pulled_box("set Size = 1, 1, 1\nset Divisions x = 40\nset Divisions y = 40\nset Divisions z = 40\n",
                           R"(set Law = isotropic elastic
subsection isotropic elastic
  set Young modulus = 30e9
  set Poisson ratio = 0.2
end
)",
                           "1e-4*t"));
    stops_within_five_seconds(folder, {"run", "x.prm", "-s", "Control/Linear solver=direct"});
  }
}
