#include "apps/bench/ranks.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_ranks_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<RanksBench> command(
      bench, "ranks",
      "Sums without loss, and a million particles shared out among ranks: cut links, ghosts, efficiency");
    command.threads(1);
    command.folder();
    command.option("--cells", &RanksBench::cells, "N", "Lattice cells along each edge, of four particles; default: 63")
      .check(CLI::Range(4, 400));
    command
      .option("--memory", &RanksBench::memory_steps, "STEPS",
              "Take so many steps, under mpirun or without, and say what memory each rank takes up")
      .check(CLI::Range(1, 1000000));
    command.flag(
      "--on-paper", &RanksBench::on_paper,
      "Instead: a cube with as many particles for each of up to 27 ranks, 10^8 links and more: efficiency "
      "by the model, and memory");
    command.flag("--quick", &RanksBench::quick, "16 lattice cells along each edge");
    command.runs(chosen, run_ranks_bench);
  }
} // namespace apps
