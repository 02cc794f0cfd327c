#include "apps/bench/structure.h"
#include "apps/bench/volume.h"
#include "apps/commands/bench_command.h"
#include "apps/process/exit_status.h"

namespace apps
{
  namespace
  {
    int run_waves_and_beam(const VolumeBench &bench)
    {
      const int waves = run_volume_bench(bench);
      if (waves != exit_success || !bench.beam)
        return waves;
      StructureBench beam; // its own scenes: entries that were set are of the waves
      beam.folder = bench.folder;
      beam.quick  = bench.quick;
      return run_structure_bench(beam);
    }
  } // namespace

  void add_volume_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<VolumeBench> command(
      bench, "volume", "Waves from particles into a continuum: reflected energy and cost, by every method");
    command.scene("scene", &VolumeBench::scene, "Scene of kind transmission");
    command.overrides();
    command.threads(1);
    command.no_cache();
    command.folder();
    command.flag("--quick", &VolumeBench::quick, "Two wavelengths only, and one method of the beam");
    command.flag("--beam", &VolumeBench::beam,
                 "Then bench structure into the same folder: error over cost of the notched beam with a core");
    command.runs(chosen, run_waves_and_beam);
  }
} // namespace apps
