#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using apps_tests::Outcome;
using apps_tests::run;
using apps_tests::ScratchFolder;
using Catch::Contains;

TEST_CASE("Help and version are answered with status 0", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       help = run(folder.path(), {"--help"});
  CHECK(help.status == 0);
  for (const char *command : {"run", "check", "describe", "pack", "link-test", "bench"})
    CHECK_THAT(help.out, Contains(command));
  for (const char *command : {"run", "describe"})
    {
      const Outcome requested = run(folder.path(), {"help", command});
      CHECK(requested.status == 0);
      CHECK(requested.out == run(folder.path(), {command, "--help"}).out);
    }
  CHECK(run(folder.path(), {"help"}).out == help.out);
  const Outcome version = run(folder.path(), {"--version"});
  CHECK(version.status == 0);
  CHECK_THAT(version.out, Catch::StartsWith("breccia 0.") && Catch::Matches(".*, kernels of (128|256|512) bits\\n"));
}

TEST_CASE("A wrong command line is refused with one message and status 2", "[apps]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::vector<std::string> &arguments, const std::string &message) {
    const Outcome outcome = run(folder.path(), arguments);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    CHECK(outcome.out.empty());
  };
  refused({}, "A subcommand is required");
  refused({"rnu", "x.prm"}, "\"rnu\" is not a command. Did you mean \"run\"?");
  refused({"help", "rnu"}, "\"rnu\" is not a command. Did you mean \"run\"?");
  refused({"optimise", "x.prm"}, "\"optimise\" is not a command. Constants are sought by \"breccia calibrate\"");
  refused({"run"}, "breccia run: scene is required");
  refused({"run", "x.prm", "--threads", "0"}, "--threads: Value 0 not in range");
  refused({"run", "x.prm", "--xylophone"}, "breccia run: \"--xylophone\" is not an option.\n");
  refused({"run", "x.prm", "--outptu=x"}, "breccia run: \"--outptu\" is not an option. Did you mean \"--output\"?");
  refused({"bench", "ranks", "--cell", "3"},
          "breccia bench ranks: \"--cell\" is not an option. Did you mean \"--cells\"?");
  refused({"--verison"}, "breccia: \"--verison\" is not an option. Did you mean \"--version\"?");
  refused({"run", "x.prm", "y.prm"}, "not expected: y.prm");
  refused({"link-test", "--law", "CPN", "--path", "x.csv"}, "law \"CPN\" is not known. Did you mean \"CPM\"?");
  refused({"describe", "Materail"}, "there is no section or entry \"Materail\". Did you mean \"Material\"?");
}
