#include "apps/process/progress.h"

#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** What is said to the standard error while it lives goes to a file, as in a log. */
  class CapturedErrors
  {
  public:
    explicit CapturedErrors(const std::filesystem::path &file)
      : before(dup(STDERR_FILENO))
    {
      const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dup2(descriptor, STDERR_FILENO);
      close(descriptor);
    }
    ~CapturedErrors()
    {
      dup2(before, STDERR_FILENO);
      close(before);
    }

  private:
    int before;
  };
} // namespace

TEST_CASE("Silent work is reported in a log by its innermost part", "[apps]")
{
  using std::chrono::milliseconds;
  const ScratchFolder folder;
  {
    const CapturedErrors captured(folder / "log");
    const apps::Progress whole("run", apps::Progress::Shown::in_logs, milliseconds(50));
    {
      apps::Progress part("factorisation", apps::Progress::Shown::everywhere, milliseconds(50));
      part.update("step 3");
      std::this_thread::sleep_for(milliseconds(60));
      part.update("step 4");
      std::this_thread::sleep_for(milliseconds(1000)); // the board updates five times a second
    }
    std::this_thread::sleep_for(milliseconds(1000));
  }
  const std::string log = content_of(folder / "log");
  INFO(log);
  CHECK_THAT(log, Contains("factorisation: step 4\n") && Contains("factorisation: step 4; ") && Contains("run: "));
  CHECK(std::count(log.begin(), log.end(), '\n') >= 6);
  CHECK(log.find("run: ") > log.rfind("factorisation: "));
}

TEST_CASE("A log reports the present progress of work, and no outdated estimate", "[apps]")
{
  using std::chrono::milliseconds;
  const ScratchFolder folder;
  {
    const CapturedErrors captured(folder / "log");
    apps::Progress       work("steps", apps::Progress::Shown::everywhere, milliseconds(300));
    work.update(0.0, "");
    std::this_thread::sleep_for(milliseconds(100));
    work.update(0.5, ""); // too early for a line: shown with the next one, also if nothing follows
    std::this_thread::sleep_for(milliseconds(1500));
  }
  const std::string log = content_of(folder / "log");
  INFO(log);
  const auto outcome = log.find("steps: 50 %, at most ");
  REQUIRE(outcome != std::string::npos);
  CHECK(log.find("at most", outcome + 20) == std::string::npos);
  CHECK_THAT(log, Contains("steps: 50 %; "));
}
