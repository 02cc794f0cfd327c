#include "apps/bench/structure.h"
#include "apps/bench/volume.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/process/exit_status.h"

#include <memory>

namespace apps
{
  void add_volume_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : VolumeBench
    {
      int  threads = 1;
      bool beam    = false;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_volume";
    CLI::App &command  = *bench.add_subcommand(
       "volume", "Waves from particles into a continuum: reflected energy and cost, by every method");
    command.add_option("scene", options->scene, "Scene of kind transmission; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Two wavelengths only, and one method of the beam");
    command.add_flag("--beam", options->beam,
                     "Then bench structure into the same folder: error over cost of the notched beam with a core");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        const int waves = run_volume_bench(*options);
        if (waves != exit_success || !options->beam)
          return waves;
        StructureBench beam; // its own scenes: entries that were set are of the waves
        beam.folder = options->folder;
        beam.quick  = options->quick;
        return run_structure_bench(beam);
      };
    });
  }
} // namespace apps
