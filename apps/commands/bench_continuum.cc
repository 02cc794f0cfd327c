#include "apps/bench/continuum.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_continuum_bench(CLI::App &bench, Action &chosen)
  {
    const auto options = std::make_shared<ContinuumBench>();
    options->folder    = "output/bench_continuum";
    CLI::App &command =
      *bench.add_subcommand("continuum", "Finite elements over element, order and solver; beside a plain deal.II loop");
    add_bench_folder(command, options->folder, "the tables and the figure");
    command.add_flag("--quick", options->quick, "Small meshes only");
    command.footer("Under mpirun only the figures that depend on the ranks are measured and added to "
                   "continuum_ranks.csv of the folder.");
    command.callback([options, &chosen] { chosen = [options] { return run_continuum_bench(*options); }; });
  }
} // namespace apps
