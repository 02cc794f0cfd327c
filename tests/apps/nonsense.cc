#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

// What makes no sense is refused by a message: it is not answered with a number, and not with a confession.

namespace
{
  void refused(const ScratchFolder &folder, const std::vector<std::string> &arguments, const std::string &message)
  {
    const Outcome outcome = run(folder.path(), arguments);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }

  std::string nested(const int depth)
  {
    std::string text;
    for (int i = 0; i < depth; ++i)
      text += "subsection a\n";
    for (int i = 0; i < depth; ++i)
      text += "end\n";
    return text + "set Kind = uniaxial\n";
  }

  std::string nested_json(const int depth)
  {
    std::string text = "{";
    for (int i = 0; i < depth; ++i)
      text += "\"a\": {";
    return text + std::string(static_cast<std::size_t>(depth), '}') + "}";
  }
} // namespace

TEST_CASE("Sections nested beyond any use are refused at once, with their line", "[apps][S14]")
{
  const ScratchFolder folder;
  for (const int depth : {33, 2000, 200000})
    {
      folder.file("deep.prm", nested(depth));
      folder.file("deep.json", nested_json(depth));
      refused(folder, {"check", "deep.prm"}, "deep.prm:33: subsection \"a\" lies within 32 others");
      refused(folder, {"check", "deep.json"}, "deep.json:1: \"a\" lies within 32 sections");
    }
}

TEST_CASE("A scene of many thousand entries is read as fast as it is long", "[apps]")
{
  const ScratchFolder folder;
  std::string         text = "set Kind = uniaxial\n";
  for (int i = 0; i < 50000; ++i)
    text += "set Entry " + std::to_string(i) + " = 1\n";
  folder.file("long.prm", text);
  refused(folder, {"check", "long.prm"}, "long.prm:2: \"Entry 0\" is not known");
}

TEST_CASE("Names are found in whatever case they are typed", "[apps]")
{
  const ScratchFolder folder;
  folder.file("path.csv", "normal_strain\n0\n5e-5\n");
  folder.file("packing.txt", pair_packing());
  std::string scene = replaced(scene_with_file(), "Kind = uniaxial", "kind = Uniaxial");
  scene             = replaced(scene, "subsection Material\n  set Law = CPM", "subsection material\n  set LAW = cpm");
  scene             = replaced(scene, "set Cohesion ", "set cohesion ");
  folder.file("x.prm", replaced(scene, "Source            = file", "Source = File"));
  const Outcome outcome = run(folder.path(), {"check", "x.prm", "-s", "material/cpm/cohesion=4e6"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);

  std::vector<std::string> link_test = {"link-test", "--law", "cpm", "--path", "path.csv"};
  for (const char *constant : {"normal modulus=1e9", "Shear ratio=0.5", "Limit elastic strain=1e-4",
                               "Relative ductility=2", "Cohesion=1e6", "Friction coefficient=0"})
    link_test.insert(link_test.end(), {"-s", constant});
  CHECK(run(folder.path(), link_test).status == 0);

  folder.file("twice.prm", replaced(scene, "    set cohesion ", "    set Cohesion = 1\n    set cohesion "));
  refused(folder, {"check", "twice.prm"}, "\"material/CPM/cohesion\" is set a second time; first in line 15");
}

TEST_CASE("Numbers that no quantity of their unit can have are refused", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", pair_packing());
  folder.file("x.prm", scene_with_file());
  const auto set = [&](const std::string &change, const std::string &message) {
    refused(folder, {"run", "x.prm", "-o", "out", "-s", change}, message);
  };
  set("Specimen/Density=1e308", "Specimen/Density = 1e308: expected a number > 0, of a size from 1e-09 to 1");
  set("Loading/Tension/Strain rate=1e300", "Loading/Tension/Strain rate = 1e300: expected a number > 0, of a size");
  set("Material/CPM/Normal modulus=1e-300", "Material/CPM/Normal modulus = 1e-300: expected a number > 0, of a size");
  set("Loading/Tension/Strain rate=1e8 1/s", "Loading, tension: strain 0.001 at 100000000 1/s would take");
}

TEST_CASE("A formula that assigns, or has several values, is refused", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  const auto formula = [&](const std::string &text, const std::string &message) {
    folder.file("x.prm", replaced(two_squares_scene(), "set Traction x = 2e6*t", "set Traction x = " + text));
    refused(folder, {"run", "x.prm", "-o", "out"}, message);
  };
  formula("y=1e-5*t", "Traction x = y=1e-5*t: expected a formula in x, y, z and t: \"=\" assigns");
  formula("1,5*t", "it has 2 values, separated by commas");
  folder.file("x.prm", replaced(two_squares_scene(), "2e6*t", "(t <= 0.5) ? 2e6*t : (t == 1 ? 1e6 : 1e6*t)"));
  const Outcome compared = run(folder.path(), {"check", "x.prm"});
  INFO(compared.err);
  CHECK(compared.status == 0);
}

TEST_CASE("Packings that cannot be made or distinguished are refused", "[apps][S14]")
{
  const ScratchFolder folder;
  refused(folder, {"pack", "--radius", "1e308 m", "--count", "20", "-o", "out"},
          "radius = 1e+308: must be a length from");
  refused(folder, {"pack", "--radius", "1e-3", "--count", "20", "--seed", "-1", "-o", "out"}, "--seed");
  refused(folder, {"pack", "--radius", "1e-3", "--count", "-5", "-o", "out"}, "--count");
  folder.file("cell.txt", "# periodic_cell 1 1 1\n0.2 0.2 0.2 0.2\n1e12 0.6 0.6 0.2\n");
  folder.file("near.txt", "# periodic_cell 1 1 1\n0.2 0.2 0.2 0.2\n0.6 0.6 0.6 0.2\n");
  const std::vector<std::string> moduli = {"--normal-modulus", "1 Pa", "--shear-ratio", "0.2"};
  const auto homogenise = [&](const std::string &packing, const std::string &ratio, const std::string &message) {
    std::vector<std::string> arguments = {"homogenise", packing, "--interaction-ratio", ratio, "-o", "out"};
    arguments.insert(arguments.end(), moduli.begin(), moduli.end());
    refused(folder, arguments, message);
  };
  homogenise("near.txt", "1e9", "Interaction ratio = 1e+09");
  homogenise("cell.txt", "1.5", "cell.txt: particle 2: centre = (1e+12, 0.6, 0.6): more than 1e9 radii");
  folder.file("cell.txt", "# periodic_cell 1 1 1\n0.2 0.2 0.2 0.2\n200.6 0.6 0.6 0.2\n");
  homogenise("cell.txt", "1.5", "particle 2: centre = (200.6, 0.6, 0.6): more than 60 periodic cells");
}
