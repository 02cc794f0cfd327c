// How the program's threads wait for each other, as libgomp itself says on its start (OMP_DISPLAY_ENV).
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

using apps_tests::Outcome;
using apps_tests::run;
using apps_tests::ScratchFolder;
using Catch::Contains;

namespace
{
  /// Variables of the environment while it lives; nothing: not set.
  class WaitEnvironment
  {
  public:
    explicit WaitEnvironment(const std::map<std::string, std::optional<std::string>> &wanted)
    {
      for (const auto &[name, value] : wanted)
        {
          const char *now = std::getenv(name.c_str());
          before[name]    = now ? std::optional<std::string>(now) : std::nullopt;
          set(name, value);
        }
    }
    ~WaitEnvironment()
    {
      for (const auto &[name, value] : before)
        set(name, value);
    }
    WaitEnvironment(const WaitEnvironment &)            = delete;
    WaitEnvironment &operator=(const WaitEnvironment &) = delete;

  private:
    static void set(const std::string &name, const std::optional<std::string> &value)
    {
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    }
    std::map<std::string, std::optional<std::string>> before;
  };

  /// What libgomp has said of a variable the last time that it was loaded, and how often it was.
  struct Said
  {
    std::string value;
    int         times = 0;
  };

  Said said_of(const std::string &name, const std::string &text)
  {
    Said              said;
    const std::string begin = name + " = '";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1), ++said.times)
      said.value = text.substr(at + begin.size(), text.find('\'', at + begin.size()) - at - begin.size());
    return said;
  }
} // namespace

TEST_CASE("Threads that wait for each other spin a microsecond and sleep then, unless the user says otherwise",
          "[apps][slow]")
{
  const ScratchFolder folder;
  const auto          threads = [&](const std::string &number) {
    const Outcome outcome =
      run(folder.path(), {"pack", "--count", "200", "--radius", "1e-3", "-o", "packing.csv", "--threads", number});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    REQUIRE_THAT(outcome.err, Contains("OPENMP DISPLAY ENVIRONMENT END"));
    return outcome.err;
  };
  const std::map<std::string, std::optional<std::string>> nothing_said = {{"OMP_DISPLAY_ENV", "verbose"},
                                                                          {"OMP_WAIT_POLICY", std::nullopt},
                                                                          {"GOMP_SPINCOUNT", std::nullopt},
                                                                          {"OMP_NUM_THREADS", std::nullopt}};
  {
    const WaitEnvironment environment(nothing_said);
    const std::string     two = threads("2");
    CHECK(said_of("GOMP_SPINCOUNT", two).value == "1000");
    CHECK(said_of("GOMP_SPINCOUNT", two).times == 2); // started anew once
    CHECK(said_of("OMP_NUM_THREADS", two).value == "2");
    CHECK(said_of("GOMP_SPINCOUNT", threads("1")).times == 1); // nobody waits
  }
  {
    auto requested              = nothing_said;
    requested["GOMP_SPINCOUNT"] = "77";
    const WaitEnvironment environment(requested);
    CHECK(said_of("GOMP_SPINCOUNT", threads("2")).value == "77");
    CHECK(said_of("GOMP_SPINCOUNT", threads("2")).times == 1);
  }
  {
    auto requested               = nothing_said;
    requested["OMP_WAIT_POLICY"] = "active";
    const WaitEnvironment environment(requested);
    CHECK(said_of("OMP_WAIT_POLICY", threads("2")).value == "ACTIVE");
  }
}
