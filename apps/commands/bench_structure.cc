#include "apps/bench/structure.h"
#include "apps/bench/structure_solvers.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_structure_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<StructureBench> command(
      bench, "structure", "A notched beam with a core of particles against one all of particles: peak load and cost");
    command.scene("whole", &StructureBench::whole, "Scene of the beam all of particles");
    command.scene("scene", &StructureBench::scene, "Scene of the beam with a core");
    command.overrides("both scenes");
    command.threads(1);
    command.no_cache();
    command.folder();
    command.flag("--quick", &StructureBench::quick, "One method only; of solvers the largest particles");
    command.flag("--solvers", &StructureBench::solvers,
                 "Instead: factors against iteration, for smaller and smaller particles of the core");
    command.runs(chosen, [](const StructureBench &what) {
      return what.solvers ? run_structure_solvers(what) : run_structure_bench(what);
    });
  }
} // namespace apps
