// What runs of elastic solids in equilibrium say: largest stresses and displacement with their places, coarse meshes, one step.
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A bar of 2 m x 1 m x 0.1 m, nu = 0, pulled at its right end by a traction and held at its left. */
  std::string bar(const std::string &traction, const std::string &more = "")
  {
    return "set Kind = continuum\nsubsection Model\n  set Dimension = 2\n  set Thickness = 0.1\nend\n"
           "subsection Mesh\n  set Source = box\n  subsection Box\n    set Size = 2, 1, 0\n    set Divisions x = 4\n"
           "    set Divisions y = 2\n  end\nend\n"
           "subsection Materials\n  subsection solid\n    set Law = isotropic elastic\n    subsection isotropic "
           "elastic\n      set Young modulus = 2e9\n      set Poisson ratio = 0\n    end\n  end\nend\n"
           "subsection Boundary conditions\n  subsection left\n    set Displacement x = 0\n    set Displacement y = 0\n"
           "  end\n  subsection right\n    set Traction x = " +
           traction + "\n  end\nend\n" + more;
  }

  const std::string hole = "Mesh/Plate with hole/";
} // namespace

TEST_CASE("A linear solid under loads that grow with time takes one step, others take twenty", "[apps]")
{
  const ScratchFolder folder;
  const auto          rows = [&](const std::string &traction, const std::string &more = "") {
    return results_of(folder, folder.file("bar.prm", bar(traction, more))).series.rows();
  };
  CHECK(rows("2e5*t") == 1);
  CHECK(rows("1e5 + 2e5*t") == 1);
  CHECK(rows("2e5*t^2") == 20);
  CHECK(rows("2e5*min(t, 0.5)") == 20);
  CHECK(rows("2e5*t", "subsection Control\n  set First step = 0.25\nend\n") == 4);
  CHECK_THAT(run(folder.path(), {"check", folder.file("bar.prm", bar("2e5*t"))}).out, Contains("steps        1,"));
}

TEST_CASE("An elastic solid reports its largest stresses and displacement, where they are, and draws them", "[apps]")
{
  const ScratchFolder folder;
  const Results       found   = results_of(folder, folder.file("bar.prm", bar("2e5*t")));
  const auto         &figures = found.summary["figures"];
  INFO(found.summary.dump(1));
  CHECK(figures["largest_principal_stress"]["value"].get<double>() == Approx(2e5));
  CHECK(figures["least_principal_stress"]["value"].get<double>() == Approx(0).margin(1));
  CHECK(figures["largest_mises_stress"]["value"].get<double>() == Approx(2e5));
  CHECK(figures["largest_displacement"]["value"].get<double>() == Approx(2e-4));
  CHECK(figures["largest_displacement"]["at"][0].get<double>() == Approx(2));
  CHECK(found.summary["warnings"].empty());
  CHECK(std::filesystem::exists(folder / "results/stress.png"));
}

TEST_CASE("A mesh that is coarse at the largest stress is reported, a fine one is not", "[apps]")
{
  const ScratchFolder folder;
  const std::string   plate    = places::sources() + "/apps/scenes/plate_with_hole.prm";
  const auto          warnings = [&](const std::string &divisions) {
    return results_of(folder, plate,
                               {"Model/Element order=1", hole + "Radial divisions=" + divisions,
                       hole + "Angular divisions=" + divisions, "Output/Snapshots=0"})
      .summary["warnings"];
  };
  const auto coarse = warnings("12"); // 6.4 of 9 MPa
  REQUIRE(coarse.size() == 1);
  CHECK_THAT(coarse[0].get<std::string>(), Contains("the mesh is coarse at the largest stress, 6.4"));
  CHECK(warnings("80").empty());
}
