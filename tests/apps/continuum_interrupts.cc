#include "tests/apps/continuum_scenes.h"
#include "tests/apps/interrupted_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <csignal>

using namespace apps_tests;

namespace
{
  std::string reproducible_part(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + content_of(results / "series.csv") + content_of(results / "solid.pvd");
  }

  /** Interrupted by a signal in the middle, then resumed: as if nothing had happened. */
  void scene_goes_on_to_the_same_bits(const std::string &scene, const int signal)
  {
    const ScratchFolder folder;
    folder.file("x.prm", replaced(scene, "subsection Output", "subsection Output\n  set Checkpoint interval = 0.001"));
    goes_on_to_the_same_bits(folder, {{"run", "x.prm"}, {"checkpoint.h5", "solid/solid_000002.vtu"}, reproducible_part},
                             {signal});
  }
} // namespace

TEST_CASE("An interrupted static run past the peak goes on to the same bits", "[apps][slow][S13]")
{
  scene_goes_on_to_the_same_bits(concrete_beam_scene(), SIGINT);
}

TEST_CASE("A killed static run that follows time goes on from its last checkpoint to the same bits",
          "[apps][slow][S13]")
{
  std::string scene = replaced(concrete_beam_scene(), "set Follow       = indirect", "set Follow = time");
  scene             = replaced(scene, "set End          = 1e-4", "set End = 6e-5");
  scene_goes_on_to_the_same_bits(scene, SIGKILL);
}

TEST_CASE("An interrupted explicit run goes on to the same bits", "[apps][slow][S13]")
{
  scene_goes_on_to_the_same_bits(replaced(impact_scene(), "set End time           = 1.9e-4", "set End time = 2e-3"),
                                 SIGINT);
}

TEST_CASE("An explicit run with damage goes on to the same bits", "[apps][slow][S13]")
{
  std::string scene = concrete_beam_scene();
  scene             = replaced(scene, "  set Plane     = stress", "  set Analysis  = explicit");
  scene             = replaced(scene, "    set Law = damage-plastic concrete",
                               "    set Law = damage-plastic concrete\n    set Density = 2400");
  scene             = replaced(scene, "set Displacement y = -t", "set Displacement y = -0.2*t");
  scene             = replaced(scene,
                               "subsection Control\n  set Follow       = indirect\n  set Opening from = left lip\n"
                                           "  set Opening to   = right lip\n  set End          = 1e-4\n  set First step   = 2e-6\nend\n",
                               "subsection Motion\n  set End time = 6e-4\nend\n");
  scene_goes_on_to_the_same_bits(scene, SIGTERM);
}
