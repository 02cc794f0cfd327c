// Structures of particles and a solid around them in equilibrium, through the program.
#include "apps/process/mpi_session.h"
#include "apps/runs/coupled/element_region.h"
#include "tests/apps/structure_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  Results bent(const char *scene, const std::vector<std::string> &changes = {})
  {
    const ScratchFolder folder;
    return results_of(folder, places::scene(scene), changes, {"control"});
  }
} // namespace

TEST_CASE("A beam with a core of particles is in equilibrium at every point of its path, with its energies in balance",
          "[apps][structure][volume][slow]")
{
  const Results found = bent("bending_with_core.prm", {"Path/End=2e-5"});
  const auto   &load = found.series.column("reaction_load_z"), &left = found.series.column("reaction_left_support_z"),
             &right = found.series.column("reaction_right_support_z"), &work = found.series.column("energy_work"),
             &residual = found.series.column("energy_residual"), &solid = found.series.column("energy_solid_stored"),
             &stored = found.series.column("energy_stored");
  REQUIRE(load.size() >= 20);
  for (std::size_t i = 0; i < load.size(); ++i)
    {
      CHECK(std::fabs(load[i] + left[i] + right[i]) < 1e-5 * std::fabs(load[i]));
      CHECK(std::fabs(residual[i]) < 0.01 * work[i]);
      CHECK(solid[i] > 0);
      CHECK(solid[i] < stored[i]); // the whole of which it is a part
    }
  CHECK(found.series.column("mean_damage").back() > 0);
  CHECK(found.summary["medium"]["difference_of_stiffness"]["value"] == 0);
  CHECK(found.summary["handshakes"]["core"]["damaged"] == 0);
}

TEST_CASE(
  "Places are as far from a group of elements as from the box that it fills, and free surfaces are no ends of it",
  "[apps][structure][volume]")
{
  apps::start_mpi();
  apps::MeshSection mesh;
  mesh.source = apps::MeshSection::Source::file;
  mesh.file = places::sources() + "/meshes/snap_back_bar.msh"; // "weak" from 0.5 to 0.55 of 1 m, over the whole height
  const auto elements = apps::elements_of(mesh, 2);
  const auto distance = elements->distance_from(apps::elements_of_group(*elements, "weak"), "weak");
  for (const double x : {0.0, 0.3, 0.499, 0.51, 0.525, 0.549, 0.56, 1.0})
    for (const double y : {-0.01, 0.0, 0.02, 0.05})
      {
        const double along = std::max(0.5 - x, x - 0.55), off = std::max(0.0, -y);
        INFO(x << ", " << y);
        CHECK(distance({x, y, 0}) == Approx(std::copysign(std::hypot(along, off), along)).margin(1e-12));
      }
  CHECK_THROWS_WITH(apps::elements_of_group(*elements, "week"), Contains("Did you mean \"weak\""));
}

TEST_CASE("A beam with a core of particles bears what one all of particles bears", "[apps][structure][volume][slow]")
{
  // Until a little past the peak.
  const Results core = bent("bending_with_core.prm", {"Path/Stop fraction=0.9"}),
                all  = bent("bending_of_particles.prm", {"Path/Stop fraction=0.9"});
  CHECK(peak_load(core) == Approx(peak_load(all)).epsilon(0.02));
}

TEST_CASE("A structure that cannot be driven is refused by name", "[apps][structure][volume][slow]")
{
  // Particles and stiffness of a run that went well, so that they are not made anew for every mistake.
  const ScratchFolder made, folder;
  const std::string   scene = places::scene("bending_with_core.prm");
  results_of(made, scene, {"Path/End=1e-6"}, {"control"});
  const std::vector<std::string> from_files = {
    "Specimen/Source=file", "Specimen/File=" + (made / "results/packing.h5").string(),
    "Continuum/Materials/concrete/anisotropic elastic/Homogenised=false",
    "Continuum/Materials/concrete/anisotropic elastic/Stiffness file=" + (made / "results/homogenised.json").string()};
  const Outcome checked = outcome_of(folder, "check", scene, from_files);
  REQUIRE(checked.status == 0);
  CHECK_THAT(checked.out, Contains("links that would cross one are left out") && !Contains(" 0 links that would"));
  const auto refused = [&](std::vector<std::string> changes, const char *words) {
    changes.insert(changes.begin(), from_files.begin(), from_files.end());
    is_refused(folder, scene, changes, words);
  };
  refused({"Path/Step=1"}, "must not be above End");
  refused({"Supports/load/Displacement z=-t*t"}, "times t, the load factor");
  refused({"Supports/load/Displacement z=-1e-5"}, "times t, the load factor");
  refused({"Supports/lode/Displacement z=-t"}, "Did you mean");
  refused({"Probes/opening/Other group=lip"}, "no such group");
  refused({"Continuum/Model/Analysis=explicit"}, "Analysis");
  refused({"Continuum/Model/Large displacement=true"}, "Large displacement");
  refused({"Continuum/Supports/left support/Displacement z=1e-6"}, "in proportion to t");
  refused({"Handshakes/core/High=0.072, 1, 1"}, "Let the region end where elements do");
  refused({"Groups/load/Lower=1, 1, 1", "Groups/load/Upper=2, 2, 2"}, "no particle's centre lies in it");
  // A tenth of the particles' stiffness: with their bonds taken off less than nothing. Shares are not taken off.
  const std::string soft  = "Continuum/Materials/concrete/Law=isotropic elastic",
                    ten   = "Continuum/Materials/concrete/isotropic elastic/Young modulus=3e9",
                    ratio = "Continuum/Materials/concrete/isotropic elastic/Poisson ratio=0.2";
  is_refused(folder, scene, {from_files[0], from_files[1], soft, ten, ratio},
             "some motions of the overlap would cost no energy");
  CHECK(outcome_of(folder, "check", scene,
                   {from_files[0], from_files[1], soft, ten, ratio, "Handshakes/core/Method=multipliers"})
          .status == 0);
  refused({"Output/Curve vertical=lode"}, "Curve vertical");
  refused({"Output/Curve vertical=opening"}, "Bending test: its load is Output/Curve vertical, here opening");
  refused({"Groups/load/Lower=0.046, -1, -1", "Groups/load/Upper=0.049, 1, 1"}, "a support leads it");
  is_refused(folder, scene,
             {"Specimen/Source=file", "Specimen/File=" + places::sources() + "/meshes/reference_cube.txt",
              "Groups/load/Lower=-1, -1, -1", "Groups/left lip/Lower=-1, -1, -1", "Groups/right lip/Lower=-1, -1, -1",
              "Groups/right lip/Upper=1, 1, 1", "Handshakes/core/Low=-1, -1, -1"},
             "Homogenised wants");
}

TEST_CASE("An interrupted or killed path of particles inside a solid goes on to the same bits",
          "[apps][structure][volume][slow][S13]")
{
  const ScratchFolder            folder;
  const std::vector<std::string> words = {
    "run", places::scene("bending_with_core.prm"), "-s", "Output/Checkpoint interval=0.01",
    "-s",  "Output/Points per snapshot=5",         "-s", "Path/End=3e-5"};
  goes_on_to_the_same_bits(folder, {words, {"solid/solid_000002.vtu", "checkpoint.h5"}, kept_of_structure},
                           {SIGINT, SIGKILL});
}
