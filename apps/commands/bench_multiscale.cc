#include "apps/bench/multiscale.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_multiscale_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<MultiscaleBench> command(
      bench, "multiscale", "Cells behind integration points: what one costs, and where needed against everywhere");
    command.scene("scene", &MultiscaleBench::scene, "Plane scene of kind continuum with cells");
    command.scene("--plate", &MultiscaleBench::plate, "Scene that is driven in equilibrium and in motion");
    command.overrides();
    command.threads(1);
    command.no_cache();
    command.folder();
    command.flag("--quick", &MultiscaleBench::quick, "Small cells, and a short part of the curve only");
    command.runs(chosen, run_multiscale_bench);
  }
} // namespace apps
