#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** The scene with one change is refused by this message; nothing is computed and no output folder appears. */
  void refused_scene(const std::string &from, const std::string &to, const std::string &message)
  {
    const ScratchFolder folder;
    folder.file("packing.txt", pair_packing());
    folder.file("x.prm", replaced(scene_with_file(), from, to));
    const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1); // one line
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
  }
} // namespace

TEST_CASE("An unknown key is refused with file, line and the nearest name", "[apps][S14]")
{
  refused_scene("Normal modulus       = 25e9", "Normal modulsu = 25e9",
                "breccia: x.prm:11: \"Material/CPM/Normal modulsu\" is not known. Did you mean \"Normal modulus\"?");
  refused_scene("set Kind = uniaxial\n", "set Kind = uniaxial\nset Cohesion = 3e6\n",
                "x.prm:2: \"Cohesion\" is not known. Did you mean \"Material/CPM/Cohesion\"?");
}

TEST_CASE("An unknown section is refused with file, line and the nearest name", "[apps][S14]")
{
  refused_scene("subsection CPM", "subsection CMP",
                "x.prm:10: section \"Material/CMP\" is not known. Did you mean \"CPM\"?");
  refused_scene("subsection Output", "subsection Outptu\nend\nsubsection Output",
                "x.prm:28: section \"Outptu\" is not known. Did you mean \"Output\"?");
}

TEST_CASE("A section of another kind of scene, and a constant that links do not have, are refused as such",
          "[apps][S14]")
{
  refused_scene("subsection Output", "subsection Groups\nend\nsubsection Output",
                "x.prm:28: section \"Groups\" is not in scenes of kind uniaxial, only in those of kind ");
  refused_scene("Cohesion             = 3e6", "Poisson ratio = 0.2",
                "\"Material/CPM/Poisson ratio\" is not known. Links have no Poisson's ratio");
}

TEST_CASE("A value that is no number, or outside its range, is refused with place, finding and range", "[apps][S14]")
{
  refused_scene("Cohesion             = 3e6", "Cohesion = three",
                "x.prm:15: Material/CPM/Cohesion = three: expected a number >= 0 [Pa]");
  refused_scene("Cohesion             = 3e6", "Cohesion = -3e6",
                "x.prm:15: Material/CPM/Cohesion = -3e6: expected a number >= 0 [Pa]");
  refused_scene("Cohesion             = 3e6", "Cohesion = nan", "Cohesion = nan: expected a number");
  refused_scene("Cohesion             = 3e6", "Cohesion = 1e999", "Cohesion = 1e999: expected a number");
  refused_scene("Cohesion             = 3e6", "Cohesion = 3 MPa",
                "Cohesion = 3 MPa: expected a number >= 0 [Pa], alone or with this unit behind it.");
  refused_scene("Cohesion             = 3e6",
                "Cohesion =", "x.prm:15: Material/CPM/Cohesion = (nothing): expected a number");
  refused_scene("Density           = 4800", "Density = 0",
                "x.prm:5: Specimen/Density = 0: expected a number > 0 [kg/m^3]");
  refused_scene("Interaction ratio = 1.5", "Interaction ratio = 0.5", "expected a number in [1, 10]");
  refused_scene("Samples   = 50", "Samples = 1.5", "Output/Samples = 1.5: expected a whole number");
  refused_scene("Source            = file", "Source = files",
                "Specimen/Source = files: expected one of: generator, file");
  refused_scene("subsection Loading", "subsection Time\n  set Step factor = 1\nend\nsubsection Loading",
                "Time/Step factor = 1: expected a number in (0, 1). Meaning: Time step");
  refused_scene("subsection Loading", "subsection Physics\n  set Damage = yes\nend\nsubsection Loading",
                "Physics/Damage = yes: expected true or false");
  refused_scene("subsection Loading", "subsection Loading\n  set Tests = tension, bending",
                "Loading/Tests = tension, bending: expected words separated by commas, of: tension, compression");
  refused_scene("subsection Loading",
                "subsection Loading\n  set Tests =", "Loading/Tests = (nothing): expected at least one of");
}

TEST_CASE("A material constant that is not set is refused by name, with its unit and meaning", "[apps][S14]")
{
  refused_scene("    set Cohesion             = 3e6\n", "",
                "x.prm: \"Material/CPM/Cohesion\" [Pa] is not set and has no default. Meaning: c_0");
  refused_scene("set Kind = uniaxial\n", "", "x.prm: \"Kind\" is not set and has no default. Known kinds: ");
  refused_scene("  set Law = CPM\n", "", "\"Material/Law\" is not set and has no default");
  refused_scene("    set Strain rate = 4\n", "", "\"Loading/Tension/Strain rate\" [1/s] is not set and has no default");
}

TEST_CASE("All entries that are missing are named at once, a line for each", "[apps]")
{
  const ScratchFolder folder;
  std::string         scene = scene_with_file();
  for (const char *line :
       {"    set Cohesion             = 3e6\n", "  set Density           = 4800\n", "  set Grip thickness = 0.5e-3\n"})
    scene = replaced(scene, line, "");
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene);
  for (const char *command : {"run", "check"})
    {
      const Outcome outcome = run(folder.path(), {command, "x.prm"});
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err, Contains("x.prm: 3 entries are not set and have no default:\n") &&
                                Contains("\n  \"Specimen/Density\" [kg/m^3]: Of the particles") &&
                                Contains("\n  \"Material/CPM/Cohesion\" [Pa]: c_0") &&
                                Contains("\n  \"Loading/Grip thickness\" [m]: "));
    }
}

TEST_CASE("An entry that is not known is answered by one of its own section, or by where these are listed", "[apps]")
{
  const ScratchFolder folder;
  const auto          answer = [&](const std::string &entry) {
    return run(folder.path(), {"check", places::sources() + "/apps/scenes/rock_triaxial.prm", "-s", entry + "=1"}).err;
  };
  CHECK_THAT(answer("Laboratory/Pressure"), Contains("is not known. Did you mean \"Confining pressure\"?"));
  CHECK_THAT(answer("Laboratory/Rate"), Contains("is not known. `breccia describe Laboratory` lists what there is."));
}

TEST_CASE("A modulus that no solid has is questioned, and taken when its unit is named", "[apps]")
{
  for (const char *value : {"25", "25000"})
    refused_scene("Normal modulus       = 25e9", std::string("Normal modulus = ") + value,
                  std::string("Material/CPM/Normal modulus = ") + value + ": no solid is so");
  refused_scene("Normal modulus       = 25e9", "Normal modulus = 25 GPa",
                "Normal modulus = 25 GPa: expected a number > 0 [Pa]");
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", replaced(scene_with_file(), "Normal modulus       = 25e9", "Normal modulus = 25000 Pa"));
  const Outcome meant =
    run(folder.path(), {"check", "x.prm", "-s", "Loading/Tests=tension", "-s", "Loading/Tension/Strain rate=1e-4"});
  INFO(meant.err);
  CHECK(meant.status == 0);
}

TEST_CASE("An unknown kind of scene is refused with the kinds there are", "[apps][S14]")
{
  refused_scene("Kind = uniaxial", "Kind = uniaxail",
                "x.prm:1: Kind = uniaxail is not known. Did you mean \"uniaxial\"?");
}

TEST_CASE("Rules between entries are refused with the place of the entry", "[apps][S14]")
{
  refused_scene("File              = packing.txt", "File = none.txt",
                "x.prm:4: Specimen/File = none.txt: there is no such file");
  refused_scene("subsection Loading", "subsection Physics\n  set Dimension = 2\nend\nsubsection Loading",
                "\"Specimen/Thickness\" [m] is not set and has no default");
  refused_scene("set Relative ductility   = 30", "set Relative ductility = 0.5\n    set Damage law = linear",
                "Relative ductility = 0.5");
  refused_scene("Grip thickness = 0.5e-3", "Grip thickness = 1", "Loading/Grip thickness = 1");
  refused_scene("Strain rate = 4", "Strain rate = 4e-12", "Loading, tension: strain 0.001 at 4e-12 1/s would take");
}

TEST_CASE("What is not a line of a parameter file is refused with its line", "[apps][S14]")
{
  refused_scene("  set Law = CPM\n", "  sett Law = CPM\n",
                "x.prm:9: \"sett Law = CPM\" is not understood: expected \"set KEY = VALUE\"");
  refused_scene("set Kind = uniaxial\n", "set Kind = uniaxial\nend\n", "x.prm:2: \"end\" closes no subsection");
  refused_scene("subsection Output", "subsection Output\nsubsection Open",
                "x.prm:28: subsection \"Output\" is not closed. Add its \"end\".");
  refused_scene("  set Law = CPM\n", "  set Law = CPM\n  set Law = CPM\n",
                "x.prm:10: \"Material/Law\" is set a second time; first in line 9");
}

TEST_CASE("A missing scene, a folder and another kind of file are refused by name", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("scene.txt", "");
  std::filesystem::create_directory(folder / "folder.prm");
  CHECK_THAT(run(folder.path(), {"run", "none.prm"}).err,
             Contains("none.prm: cannot be opened: No such file or directory"));
  CHECK_THAT(run(folder.path(), {"run", "folder.prm"}).err, Contains("folder.prm: cannot be opened: it is a folder"));
  CHECK_THAT(run(folder.path(), {"run", "scene.txt"}).err, Contains("scene.txt: a scene's name ends in .prm or .json"));
  CHECK(run(folder.path(), {"run", "none.prm"}).status == 2);
}

TEST_CASE("Changes on the command line pass the same checks, with the command line as their place", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  const auto changed = [&](const std::string &change) { return run(folder.path(), {"check", "x.prm", "-s", change}); };
  CHECK_THAT(changed("Material/CPM/Cohesio=1").err,
             Contains("command line: \"Material/CPM/Cohesio\" is not known. Did you mean \"Cohesion\"?"));
  CHECK_THAT(changed("Material/CPM/Cohesion=-1").err,
             Contains("command line: Material/CPM/Cohesion = -1: expected a number >= 0 [Pa]"));
  CHECK_THAT(changed("Cohesion").err, Contains("-s \"Cohesion\": expected \"Section/Key=value\""));
  CHECK(changed("Material/CPM/Cohesion=-1").status == 2);
  CHECK(changed("Material/CPM/Cohesion=4e6").status == 0);
}

TEST_CASE("A mix where no kind takes one is refused with the kinds that do", "[apps][S14]")
{
  const ScratchFolder folder;
  const std::string   scene   = places::sources() + "/apps/scenes/homogenisation_sweep.prm";
  const Outcome       outcome = run(folder.path(), {"check", scene, "-s", "Homogenisation/Mix/Increment=0"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("section \"Homogenisation/Mix\" is not known") &&
                            Contains("quasi_static, sequential, structure"));
}

TEST_CASE("A scene in JSON is refused with its line as well", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("a.json", "{\n\"Kind\": \"uniaxial\",\n\"Material\": {\n  \"Lwa\": \"CPM\"\n}}");
  folder.file("b.json", "{\n\"Kind\": \"uniaxial\",\n\"Time\" {}\n}");
  folder.file("c.json", "{\"Kind\": \"uniaxial\",\n\"Specimen\": {\"Box size\": [1, 2, 3]}}");
  CHECK_THAT(run(folder.path(), {"run", "a.json"}).err,
             Contains("a.json:4: \"Material/Lwa\" is not known. Did you mean \"Law\"?"));
  CHECK_THAT(run(folder.path(), {"run", "b.json"}).err, Contains("b.json:3: not valid JSON"));
  CHECK_THAT(run(folder.path(), {"run", "c.json"}).err,
             Contains("c.json:2: \"Box size\" is a list in brackets: expected a text"));
}
