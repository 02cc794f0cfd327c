// The entry Material/CPM/Shear kinematics of scenes (doc/theory/shear-kinematics.md, 3).
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  constexpr const char *note = "work of spins on links between unequal radii";

  /** Every other sphere is a little smaller. */
  std::string of_two_radii(const std::string &packing)
  {
    std::istringstream lines(packing);
    std::string        line, changed;
    for (int k = 0; std::getline(lines, line); ++k)
      changed += (line[0] != '#' && k % 2 == 0 ? line.substr(0, line.rfind(' ')) + " 0.0009" : line) + "\n";
    return changed;
  }

  struct Ran
  {
    std::string    terminal;
    nlohmann::json summary;

    bool notes() const
    {
      const bool noted = terminal.find(note) != std::string::npos;
      CHECK(summary["energy"].contains("not_in_balance") == noted);
      return noted;
    }
  };

  Ran ran(const ScratchFolder &folder, const std::string &kinematics)
  {
    const Outcome outcome =
      run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Material/CPM/Shear kinematics=" + kinematics});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return {outcome.out, nlohmann::json::parse(content_of(folder / "results/summary.json"))};
  }
} // namespace

TEST_CASE(
  "The entry Shear kinematics decides how a scene's links are sheared, and the error of the energy balance is reported",
  "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm", replaced(scene_with_file(), "  set Grip", "  set Tests = tension\n  set Grip"));
  folder.file("packing.txt", stack_packing());
  const Ran  exact = ran(folder, "exact"), first = ran(folder, "first-order");
  const auto modulus = [](const Ran &of) { return of.summary["figures"]["young_modulus"]["value"].get<double>(); };
  // Links of the stack are longer than the sum of their radii: they slip by less (doc/theory/shear-kinematics.md, 3).
  CHECK(modulus(first) < 0.999 * modulus(exact));
  CHECK(modulus(first) > 0.9 * modulus(exact));
  CHECK_FALSE(exact.notes());
  CHECK_FALSE(first.notes()); // equal radii: all is in the balance

  folder.file("packing.txt", of_two_radii(stack_packing()));
  CHECK_FALSE(ran(folder, "exact").notes());
  CHECK(ran(folder, "first-order").notes());
}

TEST_CASE("The balance error of first-order shear of unequal radii is reported by a scene of particles too", "[apps]")
{
  const ScratchFolder folder;
  std::string         scene = replaced(scene_with_file(), "Kind = uniaxial", "Kind = particles");
  const auto          begin = scene.find("subsection Loading"), end = scene.find("subsection Output");
  folder.file("x.prm", scene.replace(begin, end - begin, "subsection Time\n  set End time = 1e-5\nend\n"));
  folder.file("packing.txt", "0 0 0 0.001\n0 0 1.9e-3 0.0009\n");
  CHECK_FALSE(ran(folder, "exact").notes());
  CHECK(ran(folder, "first-order").notes());
}
