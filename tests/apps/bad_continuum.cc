#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Scene and mesh of two squares, one of them changed, are refused by this message, in one line or with a list of entries below it; nothing is written. */
  void refused_with(const std::string &scene, const std::string &mesh, const std::string &message)
  {
    const ScratchFolder folder;
    folder.file("two.msh", mesh);
    folder.file("x.prm", scene);
    const std::string before  = listing_of(folder.path());
    const Outcome     outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains(message));
    std::istringstream lines(outcome.err);
    std::string        line;
    for (int k = 0; std::getline(lines, line); ++k)
      CHECK((k == 0 || line.rfind("  \"", 0) == 0));
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(folder / "results"));
    CHECK(listing_of(folder.path()) == before);
  }

  void refused(const std::string &from, const std::string &to, const std::string &message)
  {
    refused_with(replaced(two_squares_scene(), from, to), two_squares_mesh(), message);
  }

  void refused_mesh(const std::string &from, const std::string &to, const std::string &message)
  {
    refused_with(two_squares_scene(), replaced(two_squares_mesh(), from, to), message);
  }
} // namespace

TEST_CASE("Bad meshes are refused by name", "[apps][S14]")
{
  // The corners of an element in the wrong order, or crossed.
  refused_mesh("4 3 2 12 2 2 3 6 5", "4 3 2 12 2 2 6 3 5", "two.msh: mesh: element");
  refused_mesh("4 3 2 12 2 2 3 6 5", "4 3 2 12 2 2 6 3 5", "is inverted or flat");
  // A node pulled through the opposite edge.
  refused_mesh("6 2 1 0\n", "6 0.5 -1 0\n", "is inverted or flat");
  refused_mesh("2 12 \"mortar\"\n", "2 13 \"mortar\"\n",
               "two.msh: some elements have no named group. Give every element a named physical group");
  refused_with(two_squares_scene(),
               replaced(replaced(two_squares_mesh(), "6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n",
                                 "8\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 1.1 0 0\n8 1.1 1 0\n"),
                        "4 3 2 12 2 2 3 6 5", "4 3 2 12 2 7 3 6 8"),
               "two.msh: mesh: it falls into 2 unconnected parts; the smallest has 1 elements");
  refused_with(two_squares_scene(), "solid cube\n", "two.msh: is not a Gmsh file");
  refused("set File   = two.msh", "set File = three.msh", "x.prm:8: Mesh/File = three.msh: there is no such file");
}

TEST_CASE("A solid that its supports let go is refused by the motion that is free", "[apps][S14]")
{
  refused("    set Displacement y = 0\n", "", "supports: the solid can move as a rigid body (mainly translation y)");
  refused("    set Displacement x = 0\n    set Displacement y = 0\n", "",
          "supports: the solid can move as a rigid body");
}

TEST_CASE("Names that the mesh does not have are refused with the nearest one", "[apps][S14]")
{
  refused("subsection right\n", "subsection rigth\n",
          "x.prm:31: Boundary conditions/rigth: the mesh has no boundary of this name. Did you mean \"right\"? It has: "
          "left, right.");
  refused("subsection mortar\n", "subsection morta\n",
          "x.prm:18: Materials/morta: the mesh has no group of elements of this name. Did you mean \"mortar\"?");
  refused("  subsection mortar\n    set Law = isotropic elastic\n    subsection isotropic elastic\n"
          "      set Young modulus = 20e9\n      set Poisson ratio = 0\n    end\n  end\n",
          "", "Materials: the group \"mortar\" of the mesh has no law. Add subsection Materials/mortar.");
}

TEST_CASE("A boundary or material that names a physical group of another dimension is refused as such", "[apps][S14]")
{
  refused(
    "subsection right\n", "subsection stone\n",
    "Boundary conditions/stone: the mesh has no boundary of this name. The physical group of this name is a Physical "
    "Surface, of dimension 2; a Physical Curve is wanted here.");
  refused(
    "subsection mortar\n", "subsection right\n",
    "Materials/right: the mesh has no group of elements of this name. The physical group of this name is a Physical "
    "Curve, of dimension 1; a Physical Surface is wanted here.");
}

TEST_CASE("A mesh without named boundaries is refused with the way to name them", "[apps][S14]")
{
  const std::string bare =
    replaced(replaced(two_squares_mesh(), "1 1 \"left\"\n1 2 \"right\"\n", ""), "4\n2 11", "2\n2 11");
  refused_with(two_squares_scene(),
               replaced(replaced(bare, "1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n", ""), "$Elements\n4\n", "$Elements\n2\n"),
               "the mesh has no boundary of this name. Put its edges into a physical group in Gmsh, Physical "
               "Curve(\"left\"), and save the mesh with it. It has: none.");
}

TEST_CASE("Elements too wide for the fracture energy of their concrete are refused by check and run alike",
          "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("x.prm", pulled_box("set Size = 2, 1, 1\nset Divisions x = 4\n", R"(set Law = damage-plastic concrete
subsection damage-plastic concrete
  set Young modulus        = 33e9
  set Poisson ratio        = 0.2
  set Compressive strength = 40e6
  set Tensile strength     = 3e6
  set Fracture energy      = 100
end
)",
                                  "1e-5*t"));
  // They are 0.5 m wide, E w_f / f_t is 0.367 m; the load is far from cracking anything.
  std::string said;
  for (const char *verb : {"check", "run"})
    {
      const Outcome outcome = run(folder.path(), {verb, "x.prm"});
      INFO(outcome.err);
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err,
                 Contains("Materials/solid: element size [m] = 0.5: must be below E w_f / f_t = 0.366667 m"));
      CHECK((said.empty() || said == outcome.err));
      said = outcome.err;
    }
  const std::vector<std::string> fine    = {"-s", "Mesh/Box/Divisions x=8"};
  const auto                     checked = [&](std::vector<std::string> words, const std::vector<std::string> &more) {
    words.insert(words.end(), more.begin(), more.end());
    return run(folder.path(), words);
  };
  const Outcome whole = checked({"check", "x.prm"}, fine);
  CHECK(whole.status == 0);
  CHECK_THAT(whole.out, !Contains("warning"));
}

TEST_CASE("A byte order mark before a scene is passed over", "[apps][S14]")
{
  refused_with("\xEF\xBB\xBF" + replaced(two_squares_scene(), "subsection right\n", "subsection rigth\n"),
               two_squares_mesh(), "x.prm:31: Boundary conditions/rigth: the mesh has no boundary of this name.");
}

TEST_CASE("Keys, values and formulas of a continuum scene are refused with their place", "[apps][S14]")
{
  refused("set Traction x", "set Tracton x",
          "x.prm:32: \"Boundary conditions/right/Tracton x\" is not known. Did you mean \"Traction x\"?");
  refused("set Young modulus = 20e9", "set Young modulus = -20e9",
          "x.prm:21: Materials/mortar/isotropic elastic/Young modulus = -20e9: expected a number");
  refused("      set Young modulus = 20e9\n", "",
          "\"Materials/mortar/isotropic elastic/Young modulus\" [Pa] is not set and has no default");
  refused("Law = isotropic elastic", "Law = elastic",
          "Materials/stone/Law = elastic: expected one of: isotropic elastic");
  refused("2e6*t", "2e6*time",
          "x.prm:32: Boundary conditions/right/Traction x = 2e6*time: expected a formula in x, y, z and t");
  refused("2e6*t", "2e6*(t", "expected a formula in x, y, z and t");
  refused("set Traction x = 2e6*t", "set Traction z = 2e6*t",
          "a plane model has no displacement along z (Model/Dimension = 2)");
  refused("set First step = 0.5", "set First step = 0.5\n  set Largest step = 0.1",
          "Control/First step = 0.5: it must lie between the smallest and the largest step");
  refused("set First step = 0.5", "set First step = 0.5\n  set Follow = arc length\n  set Relax = true",
          "Control/Relax = true: goes with Control/Follow = time");
  refused("set First step = 0.5", "set Follow = indirect\n  set Opening from = ende\n  set Opening to = end",
          "Control/Opening from = ende: there is no such point. Did you mean \"end\"?");
  refused("set Position = 2, 0.5, 0", "set Position = 2, 1.5, 0", "Points/end");
  refused("subsection Points",
          "subsection Point forces\n  subsection f\n    set Position = 3, 0, 0\n    set Force x = 1\n"
          "  end\nend\nsubsection Points",
          "lies outside");
  refused("subsection Points",
          "subsection Supports\n  subsection s\n    set From = 0.3, 0.3, 0\n    set Displacement y = 0\n  end\nend\n"
          "subsection Points",
          "no node lies in it");
  refused("subsection Points",
          "subsection Supports\n  subsection s\n    set From = 0, 0, 0\n    set Displacement y = 1e-3*t\n  end\nend\n"
          "subsection Points",
          "two boundary conditions prescribe");
  refused("set First step = 0.5",
          "set First step = 0.5\nend\nsubsection Output\n  set Curve vertical = reaction_left_z",
          "Output/Curve vertical = reaction_left_z: series.csv has no such column. Did you mean \"reaction_left_x\"?");
  refused("set Plane     = stress", "set Analysis = explicit", "\n  \"Materials/stone/Density\" [kg/m^3]: ");
}

TEST_CASE("A formula that gives no number stops the run with its name and the place", "[apps][S14]")
{
  const ScratchFolder folder;
  folder.file("two.msh", two_squares_mesh());
  folder.file("x.prm", replaced(two_squares_scene(), "2e6*t", "2e6*sqrt(0.6 - t)"));
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Contains("x.prm:32: Boundary conditions/right/Traction x = 2e6*sqrt(0.6 - t): is ") &&
                            Contains("nan at x = 2"));
}
