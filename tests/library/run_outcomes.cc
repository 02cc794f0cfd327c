// What is said of a run before it (apps/results/run_outcome.h) against what it finds: of every kind of scene.
#include "apps/results/run_result.h"
#include "apps/scene/kinds/kinds.h"
#include "apps/scene/kinds/read_scene.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <set>

using apps_tests::ScratchFolder;

namespace
{
  /** A shipped scene, made small. */
  struct SmallScene
  {
    std::string              file;
    std::vector<std::string> changes;
    std::size_t              fewest = 4; ///< figures that its run finds
  };

  const std::vector<SmallScene> small_scenes = {
    {"quick_uniaxial.prm", {"Specimen/Box size=0.02, 0.02, 0.03", "Loading/Compression/Stop strain=1e-3"}},
    {"quick_uniaxial.prm", {"Loading/Tests=compression", "Loading/Compression/Stop strain=3e-4"}},
    {"quasi_static.prm", {"Loading/Tests=tension", "Loading/Tension/Stop strain=5e-5"}},
    {"studies/mortar_quarter.prm", {"Specimen/Genesis/Size=0.01, 0.02, 0"}},
    {"studies/law_cyclic_cell.prm", {"Specimen/Generator/Cell particles=100", "Loading/Leg 3/Duration=1e-4"}},
    {"bouncing_sphere.prm", {}},
    {"plate_with_hole.prm", {"Mesh/Plate with hole/Radial divisions=3", "Mesh/Plate with hole/Angular divisions=4"}},
    {"notched_beam.prm", {"Control/End=2e-5"}},
    {"bar_impact.prm", {"Motion/End time=2e-6", "Output/Samples=2"}, 2},
    {"colliding_balls.prm", {"Motion/End time=1e-6", "Output/Samples=1"}, 1},
    {"crushed_cube.prm", {"Time/End time=1e-5", "Output/Samples=2"}},
    {"beam_and_spheres.prm", {"Time/End time=0.1", "Output/Samples=2"}},
    {"bending_of_particles.prm", {"Path/End=1e-6"}},
    {"peridynamic_core.prm", {"Time/End time=1e-6", "Output/Samples=2"}},
    {"peridynamic_hole.prm", {"Grid/Spacing=0.02"}},
    {"peridynamic_impact.prm", {"Analysis/End time=1e-7", "Output/Samples=2"}},
    {"homogenisation_sweep.prm",
     {"Homogenisation/Particles=100", "Homogenisation/Seeds=1", "Homogenisation/Interaction ratios=1.5",
      "Homogenisation/Shear ratios=0.2, 0.5"}},
    {"wave_transmission.prm", {"Waves/Methods=coarse, absorber", "Waves/Wavelengths=0.16"}},
    {"transfer_compression.prm",
     {"Particles/Specimen/Box size=0.011, 0.011, 0.018", "Particles/Specimen/Generator/Cell particles=100",
      "Particles/Specimen/Generator/Seed=2", "Particles/Uniaxial/Grip thickness=2.2e-3",
      "Particles/Uniaxial/Strain rate=8", "Particles/Uniaxial/End strain=-6e-4", "Particles/Uniaxial/Area=nominal",
      "Particles/Uniaxial/Instants=-4e-4", "Transfer/Mapping law/Law=default",
      "Continuum/Mesh/Box/Size=0.011, 0.011, 0.018", "Continuum/Boundary conditions/front/Displacement z=-0.018*t",
      "Continuum/Points/top/Position=0, 0, 0.018", "Continuum/Control/End=3.5e-4", "Study/Length=0.018",
      "Study/Area=1.21e-4"}}};

  const std::size_t kinds_of_the_program = apps::scene_kinds().size(); // before a test adds one of its own

  apps::CheckedScene read(const SmallScene &small)
  {
    return apps::read_scene(places::sources() + "/apps/scenes/" + small.file, small.changes);
  }
} // namespace

TEST_CASE("what a run finds is among the names that are known before it", "[apps][slow]")
{
  const SmallScene         small   = GENERATE(from_range(small_scenes));
  const apps::CheckedScene scene   = read(small);
  apps::RunRequest         request = apps::request_of(scene);
  request.output_folder.clear();
  INFO(small.file);
  const std::optional<apps::RunOutcome> known = scene.scene->outcome();
  REQUIRE(known);
  const apps::RunResult found = scene.scene->run(request);
  CHECK(found.series.names == known->columns);
  CHECK(found.figures().size() >= small.fewest);
  for (const std::string &name : found.figures())
    CHECK_NOTHROW(known->demand_figure(name));
}

TEST_CASE("every kind of scene is among those whose names are proved", "[apps]")
{
  std::set<std::string> proved;
  for (const SmallScene &small : small_scenes)
    proved.insert(read(small).kind);
  CHECK(proved.size() == kinds_of_the_program);
}
