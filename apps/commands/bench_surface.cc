#include "apps/bench/surface.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_surface_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<SurfaceBench> command(
      bench, "surface", "Impact on a solid, and of solids: force and time over mesh, step, sub-cycling and spreading");
    command.option("scene", &SurfaceBench::scenes, "SCENE",
                   "Scenes of kind coupled, or of balls in contact, with known answers; default: "
                   "apps/scenes/hertz_impact.prm and apps/scenes/colliding_balls.prm");
    command.overrides("the scenes");
    command.threads(1);
    command.folder();
    command.flag("--quick", &SurfaceBench::quick, "Coarse meshes only");
    command.runs(chosen, run_surface_bench);
  }
} // namespace apps
