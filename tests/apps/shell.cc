// What helps at a terminal: completion, the page for man, scenes to start from, results beside each other, pictures again.
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string printed(const ScratchFolder &folder, const char *what)
  {
    const Outcome outcome = run(folder.path(), {"shell", what});
    REQUIRE(outcome.status == 0);
    return outcome.out;
  }

  /** What bash offers where the last of these words is being typed. */
  std::string offered(const ScratchFolder &folder, const std::string &script, const std::string &words)
  {
    folder.file("completion.bash", script);
    const std::string command =
      "cd " + folder.path().string() + " && bash -c 'source completion.bash; COMP_WORDS=(" + words +
      "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _breccia; echo \"${COMPREPLY[*]}\"' > offered";
    REQUIRE(std::system(command.c_str()) == 0);
    return content_of(folder / "offered");
  }

  void leave_two_runs(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", scene_with_file());
    for (const char *samples : {"20", "40"})
      REQUIRE(run(folder.path(), {"run", "x.prm", "-o", std::string("of_") + samples, "-s",
                                  std::string("Output/Samples=") + samples, "-s", "Output/Snapshots=0"})
                .status == 0);
  }
} // namespace

TEST_CASE("Completion for bash offers commands, their options, choices of these, and files", "[apps]")
{
  const ScratchFolder folder;
  const std::string   script = printed(folder, "bash");
  CHECK(offered(folder, script, "breccia va") == "validate\n");
  CHECK(offered(folder, script, "breccia run --re") == "--resume --restart\n");
  CHECK(offered(folder, script, "breccia shell z") == "zsh\n");
  folder.file("some_scene.prm", "");
  CHECK(offered(folder, script, "breccia run some_") == "some_scene.prm\n");
}

TEST_CASE("Completion for zsh completes commands, their options, choices of these, and files, in zsh itself",
          "[apps][zsh]")
{
  if (std::system("command -v zsh > /dev/null") != 0)
    {
      std::cout << "Skipped: there is no zsh.\n";
      return;
    }
  const ScratchFolder folder;
  folder.file("_breccia", printed(folder, "zsh"));
  folder.file("some_scene.prm", "");
  const std::string command =
    "timeout 60 zsh -f " + places::sources() + "/tests/apps/completion.zsh " + folder.path().string() +
    " 'breccia va' 'breccia run --resu' 'breccia shell z' 'breccia run some_' > " + (folder / "offered").string();
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(content_of(folder / "offered") ==
        "breccia validate \nbreccia run --resume \nbreccia shell zsh \nbreccia run some_scene.prm \n");
}

TEST_CASE("Completion for zsh and the page for man have every command with its options", "[apps]")
{
  const ScratchFolder folder;
  const std::string   zsh = printed(folder, "zsh"), page = printed(folder, "man");
  CHECK_THAT(zsh, Catch::StartsWith("#compdef breccia") && Contains("'run:Run a scene and write its results'") &&
                    Contains("'*--resume[") && Contains("(bash zsh man)"));
  CHECK_THAT(page, Catch::StartsWith(".TH BRECCIA 1") && Contains("\n.SS link\\-test\n") &&
                     Contains("\\fB\\-\\-resume\\fR") && Contains("\\fB\\-\\-output\\fR \\fIDIR\\fR"));
  CHECK_THAT(page, !Contains("\n.\n")); // a line that would be a request
  const Outcome wrong = run(folder.path(), {"shell", "fish"});
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.err, Contains("fish"));
}

TEST_CASE("A new scene of each kind wants nothing but what must be given", "[apps]")
{
  const ScratchFolder folder;
  for (const char *kind : {"cell", "continuum", "coupled", "homogenisation", "particles", "peridynamic_core",
                           "peridynamics", "quasi_static", "sequential", "structure", "transmission", "uniaxial"})
    {
      INFO(kind);
      REQUIRE(run(folder.path(), {"new", kind}).status == 0);
      const Outcome checked = run(folder.path(), {"check", std::string(kind) + ".prm"});
      CHECK(checked.status == 2);
      CHECK_THAT(checked.err, !Contains("unknown") && !Contains("is not known") && !Contains("line "));
    }
  CHECK_THAT(content_of(folder / "uniaxial.prm"),
             Contains("\nset Kind = uniaxial\n") && Contains("# set Density = (to be given)") && Contains("[kg/m^3]"));
  const Outcome twice = run(folder.path(), {"new", "uniaxial"});
  CHECK(twice.status == 2);
  CHECK_THAT(twice.err, Contains("uniaxial.prm: is there already"));
  CHECK_THAT(run(folder.path(), {"new", "uniaxal"}).err, Contains("Did you mean \"uniaxial\"? Known kinds: cell ("));
  CHECK_THAT(run(folder.path(), {"new", "beam"}).err, Contains("kind \"beam\" is not known. Known kinds: cell ("));
}

TEST_CASE("diff finds no difference between a result and itself, and says where two differ most", "[apps]")
{
  const ScratchFolder folder;
  leave_two_runs(folder);
  const Outcome same = run(folder.path(), {"diff", "of_20", "of_20"});
  CHECK(same.status == 0);
  CHECK_THAT(same.out, Contains("figures: the same bits") && Contains("series: the same bits") &&
                         Contains("files of the same bytes:") && !Contains("other bytes"));

  // Figures are those of all steps, whatever the rows.
  const Outcome rows = run(folder.path(), {"diff", "of_20", "of_40"});
  CHECK(rows.status == 1);
  CHECK_THAT(rows.out, Contains("figures: the same bits") && Contains("series.csv") && Contains(" rows and "));

  std::string series = content_of(folder / "of_20/series.csv");
  const auto  last   = series.rfind('\n', series.size() - 2) + 1;
  const auto  comma  = series.find(',', series.find(',', last) + 1); // before the strain's next column
  series.insert(comma, "1");                                         // one digit more of the strain in the last row
  std::filesystem::copy(folder / "of_20", folder / "changed");
  folder.file("changed/series.csv", series);
  const Outcome digit = run(folder.path(), {"diff", "of_20", "changed"});
  CHECK(digit.status == 1);
  CHECK_THAT(digit.out,
             Contains("series: 1 differ") && Contains("most in row") && Contains("of other bytes: series.csv"));
  CHECK(run(folder.path(), {"diff", "of_20", "changed", "--tolerance", "1"}).status == 0);
  const Outcome none = run(folder.path(), {"diff", "of_20", "x.prm"});
  CHECK(none.status == 2);
}

TEST_CASE("plot draws other columns of a result, and lists them where it knows none of that name", "[apps]")
{
  const ScratchFolder folder;
  leave_two_runs(folder);
  REQUIRE(run(folder.path(), {"plot", "of_20", "-x", "strain", "-y", "stress,mean_damage", "-o", "two.png"}).status ==
          0);
  CHECK_THAT(content_of(folder / "two.png"), Catch::StartsWith("\x89PNG"));
  REQUIRE(run(folder.path(), {"plot", "of_20"}).status == 0);
  CHECK(std::filesystem::file_size(folder / "of_20/plot.png") > std::filesystem::file_size(folder / "two.png"));
  const Outcome none = run(folder.path(), {"plot", "of_20", "-y", "stres"});
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("stres") && Contains("mean_damage"));
  CHECK_FALSE(std::filesystem::exists(folder / "plot.png"));
  CHECK(run(folder.path(), {"plot", "of_20", "-x", "strain"}).status == 2);
}
