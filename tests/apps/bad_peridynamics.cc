// Peridynamic scenes that are refused: apart from those that run, as MPI once started costs every further program half a second.
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace apps_tests;

namespace
{
  std::string peridynamic(const std::string &name)
  {
    return places::sources() + "/apps/scenes/peridynamic_" + name + ".prm";
  }
} // namespace

TEST_CASE("A horizon below one spacing is refused by name", "[apps]")
{
  const ScratchFolder folder;
  is_refused(folder, peridynamic("tension"), {"Horizon/Ratio=0.9"}, "Horizon/Ratio = 0.9");
}

TEST_CASE("A spacing that does not divide the body is refused by name", "[apps]")
{
  const ScratchFolder folder;
  is_refused(folder, peridynamic("tension"), {"Grid/Spacing=0.03"}, "Grid/Spacing = 0.03: must divide every length");
  is_refused(folder, peridynamic("bar"), {"Grid/Spacing=0.03"}, "1 m are 33.3333 spacings");
}

TEST_CASE("A Poisson's ratio that bonds cannot have is refused by name, in every kind of space", "[apps]")
{
  const ScratchFolder folder;
  is_refused(folder, peridynamic("tension"), {"Material/Poisson ratio=0.2"},
             "Material/Poisson ratio = 0.2: bonds have 0.333333 here");
  is_refused(folder, peridynamic("impact"), {"Material/Poisson ratio=0.333"}, "bonds have 0.25 here");
  is_refused(folder, peridynamic("block"), {"Material/Poisson ratio=0.3"}, "bonds have 0.25 here");
  is_refused(folder, peridynamic("bar"), {"Material/Poisson ratio=0.25"}, "a rod has none");
}

TEST_CASE("Tractions that do not balance on a free body are refused by name", "[apps]")
{
  const ScratchFolder folder;
  is_refused(folder, peridynamic("tension"), {"Tractions/above/Value=0, 100e6"}, "Tractions: do not balance");
  is_refused(folder, peridynamic("tension"),
             {"Tractions/above/Value=10e6, 200e6", "Tractions/below/Value=-10e6, -200e6"},
             "Tractions: do not balance"); // a moment
}

TEST_CASE("An isolated node is refused by name", "[apps]")
{
  // A horizon of one spacing, and cracks around a corner.
  const ScratchFolder folder;
  is_refused(folder, peridynamic("tension"),
             {"Horizon/Ratio=1", "Cracks/across/From=-0.49, -0.3", "Cracks/across/To=-0.49, 0",
              "Cracks/along/From=-0.6, -0.24", "Cracks/along/To=0, -0.24"},
             "m is isolated: no bond leads to it");
}

TEST_CASE("Peridynamic scenes that cannot be are refused by name", "[apps]")
{
  const ScratchFolder folder;
  const std::string   scene   = peridynamic("tension");
  const auto          refused = [&](const std::vector<std::string> &changes, const std::string &words) {
    is_refused(folder, scene, changes, words, {"check"});
  };
  refused({"Body/Size=1, 0.5, 2, 3"}, "one to three lengths");
  refused({"Tractions/above/Boundary=front"}, "left, right, bottom, top");
  refused({"Tractions/above/Value=0, 100e6, 3"}, "component along z");
  refused({"Tractions/above/Value=0, 100e6 +"}, "formulas");
  refused({"Analysis/Method=motion", "Analysis/End time=1e-4"}, "Density");
  refused({"Material/Critical stretch=0.01", "Material/Fracture energy=100"}, "leave one of them out");
  is_refused(folder, peridynamic("hole"), {"Holes/hole/Radius=0.4"}, "Holes", {"check"});
  refused({"Cracks/beside/From=2, 0", "Cracks/beside/To=3, 0"}, "no bond crosses it");

  const std::string concrete = peridynamic("concrete");
  is_refused(folder, concrete, {"Material/Young modulus=1e9"}, "single one", {"check"});
  is_refused(folder, concrete, {"Interfaces/transition zone/Material=morter"}, "Did you mean \"mortar\"", {"check"});
  is_refused(folder, concrete, {"Interfaces/transition zone/Critical stretch=1e-3"}, "leave one of them out",
             {"check"});
  is_refused(folder, concrete, {"Regions/stone 1/Material=gravel"}, "is not in section Materials", {"check"});
  is_refused(folder, concrete, {"Materials/steel/Young modulus=200e9", "Materials/steel/Density=7800"},
             "no node is of it", {"check"});
  is_refused(folder, scene, {"Regions/a/Material=b", "Regions/a/Radius=1", "Regions/a/Centre=0, 0, 0"},
             "no section Materials", {"check"});
}

TEST_CASE("Scenes with a peridynamic core that cannot be are refused by name", "[apps]")
{
  const ScratchFolder folder;
  const auto          refused = [&](const std::string &change, const std::string &words) {
    is_refused(folder, peridynamic("core"), {change}, words, {"check"});
  };
  refused("Core/Body/Size=0.12", "has 1 lengths, but Continuum/Model/Dimension = 2");
  refused("Core/Body/Thickness=0.2", "must be Continuum/Model/Thickness, 0.1 m");
  refused("Core/Body/Plane=strain", "must be that of Continuum/Model");
  refused("Core/Grid/Spacing=0.007", "must divide every length");
  refused("Core/Material/Density=0", "Density");
  refused("Handshake/Sides=left, rihgt", "Did you mean \"right\"");
  refused("Handshake/Overlap=0.06", "leaves nothing of the core");
  refused("Continuum/Mesh/Boxes/beam/Size=0.48, 0.12, 0", "lies beside the core");
  refused("Core/Cracks/notch/To=0, -0.055", "Core/Cracks/notch: no bond crosses it");
  is_refused(folder, peridynamic("core"), {"Core/Tractions/pull/Boundary=left", "Core/Tractions/pull/Value=1e6, 0"},
             "nothing can act there", {"check"});
  // The core is longer than the beam.
  is_refused(folder, peridynamic("core"), {"Core/Body/Size=0.49, 0.1", "Handshake/Overlap=0.05"},
             "Let the mesh reach through the overlap", {"check"});
}
