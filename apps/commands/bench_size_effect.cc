#include "apps/bench/size_effect.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_size_effect_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<SizeEffectBench> command(
      bench, "size-effect",
      "Beams of one shape and several sizes, notched and smooth: strengths beside laws of size effect");
    command.scene("scene", &SizeEffectBench::scene, "Scene of the smallest beam");
    command.overrides();
    command.threads(1);
    command.no_cache();
    command.folder();
    command.list("--sizes", &SizeEffectBench::sizes, "N,...", "Over that of the scene; default: 1,2,4,8")
      .check(CLI::Range(1, 64));
    command
      .option("--geometries", &SizeEffectBench::geometries, "N", "Of particles and aggregates, per size; default: 3")
      .check(CLI::Range(1, 1000));
    command.option("--calibrated", &SizeEffectBench::calibrated, "N",
                   "Size from which alone the others are predicted; default: 2");
    command
      .list("--particles", &SizeEffectBench::particles, "N,...",
            "Of the sizes, beams all of particles beside; 0: none; default: 1,2")
      .check(CLI::Range(0, 64));
    command.flag("--notched-only", &SizeEffectBench::notched_only, "No beams without a notch");
    command.part(
      &SizeEffectBench::part, &SizeEffectBench::parts,
      "Only the third of forty parts of the beams, for processes that share the folder; the last one writes the table");
    command.flag("--restart", &SizeEffectBench::restart, "Throw away what an interrupted bench has left in the folder");
    command.flag("--quick", &SizeEffectBench::quick, "One geometry of sizes 1 and 2, with a notch");
    command.runs(chosen, run_size_effect_bench);
  }
} // namespace apps
