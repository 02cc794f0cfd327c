#include "apps/bench/homogenise.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_homogenise_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<HomogeniseBench> command(bench, "homogenise",
                                          "Macroscopic stiffness over cell size, solver, tolerance and seed");
    command.folder();
    command
      .list("--particles", &HomogeniseBench::particles, "N,N,...",
            "Cells of the study of solvers; default: 500,1000,4000")
      .check(CLI::Range(8, 1000000));
    command
      .list("--seed-particles", &HomogeniseBench::seed_particles, "N,N,...",
            "Cells of the study of seeds; default: 64,...,2000")
      .check(CLI::Range(8, 1000000));
    command.option("--seeds", &HomogeniseBench::seeds, "N", "Packings per cell size; default: 8")
      .check(CLI::Range(2, 1000));
    command.option("--interaction-ratio", &HomogeniseBench::interaction_ratio, "IOTA", "default: 1.5")
      .check(CLI::Range(1.0, 10.0));
    command.option("--shear-ratio", &HomogeniseBench::shear_ratio, "G/E", "default: 0.2").check(CLI::PositiveNumber);
    command.flag("--quick", &HomogeniseBench::quick, "Cells of 64 and 125 spheres, three seeds");
    command.threads(1);
    command.no_cache();
    command.runs(chosen, run_homogenise_bench);
  }
} // namespace apps
