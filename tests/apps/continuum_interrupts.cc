#include "tests/apps/continuum_scenes.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <thread>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Start the scene and, as soon as there is a checkpoint and the series has grown, signal it. */
  Outcome interrupted_run(const ScratchFolder &folder, const int signal)
  {
    Program program(folder.path(), {"run", "x.prm", "-o", "results"});
    while (program.running())
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::error_code not_yet;
        if (std::filesystem::exists(folder / "results/running/checkpoint.h5") &&
            std::filesystem::exists(folder / "results/running/solid/solid_000002.vtu", not_yet))
          {
            program.send(signal);
            return program.wait();
          }
      }
    return program.wait();
  }

  std::string reproducible_part(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + content_of(results / "series.csv") + content_of(results / "solid.pvd");
  }

  /** Interrupted by a signal in the middle, then resumed: as if nothing had happened. */
  void goes_on_to_the_same_bits(const std::string &scene, const int signal)
  {
    const ScratchFolder folder;
    folder.file("x.prm", replaced(scene, "subsection Output", "subsection Output\n  set Checkpoint interval = 0.001"));
    REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "whole"}).status == 0);
    const Outcome stopped = interrupted_run(folder, signal);
    INFO(stopped.err);
    if (signal == SIGKILL)
      REQUIRE(stopped.status == 128 + SIGKILL);
    else
      {
        REQUIRE(stopped.status == 130);
        CHECK_THAT(stopped.err, Contains("Go on with: breccia run results/running/scene.prm --resume"));
      }
    CHECK_FALSE(std::filesystem::exists(folder / "results/summary.json"));
    const Outcome resumed = run(folder.path(), {"run", "x.prm", "-o", "results", "--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    CHECK(reproducible_part(folder / "results") == reproducible_part(folder / "whole"));
  }
} // namespace

TEST_CASE("An interrupted static run past the peak goes on to the same bits", "[apps][slow][S13]")
{
  goes_on_to_the_same_bits(concrete_beam_scene(), SIGINT);
}

TEST_CASE("A killed static run that follows time goes on from its last checkpoint to the same bits",
          "[apps][slow][S13]")
{
  std::string scene = replaced(concrete_beam_scene(), "set Follow       = indirect", "set Follow = time");
  scene             = replaced(scene, "set End          = 1e-4", "set End = 6e-5");
  goes_on_to_the_same_bits(scene, SIGKILL);
}

TEST_CASE("An interrupted explicit run goes on to the same bits", "[apps][slow][S13]")
{
  goes_on_to_the_same_bits(replaced(impact_scene(), "set End time           = 1.9e-4", "set End time = 2e-3"), SIGINT);
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
  goes_on_to_the_same_bits(scene, SIGTERM);
}
