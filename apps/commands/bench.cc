#include "apps/commands/command.h"

namespace apps
{
  void add_calibration_bench(CLI::App &bench, Action &chosen);
  void add_confined_bench(CLI::App &bench, Action &chosen);
  void add_conservation_bench(CLI::App &bench, Action &chosen);
  void add_continuum_bench(CLI::App &bench, Action &chosen);
  void add_homogenise_bench(CLI::App &bench, Action &chosen);
  void add_mesoscale_bench(CLI::App &bench, Action &chosen);
  void add_mortar_bench(CLI::App &bench, Action &chosen);
  void add_multiscale_bench(CLI::App &bench, Action &chosen);
  void add_peridynamics_bench(CLI::App &bench, Action &chosen);
  void add_sequential_bench(CLI::App &bench, Action &chosen);
  void add_quasi_static_bench(CLI::App &bench, Action &chosen);
  void add_ranks_bench(CLI::App &bench, Action &chosen);
  void add_rate_effect_bench(CLI::App &bench, Action &chosen);
  void add_size_effect_bench(CLI::App &bench, Action &chosen);
  void add_structure_bench(CLI::App &bench, Action &chosen);
  void add_surface_bench(CLI::App &bench, Action &chosen);
  void add_uniaxial_bench(CLI::App &bench, Action &chosen);
  void add_volume_bench(CLI::App &bench, Action &chosen);

  void add_bench(CLI::App &program, Action &chosen)
  {
    CLI::App &bench = *program.add_subcommand("bench", "Speed against error, as a table and a figure");
    bench.require_subcommand(1);
    add_calibration_bench(bench, chosen);
    add_confined_bench(bench, chosen);
    add_conservation_bench(bench, chosen);
    add_continuum_bench(bench, chosen);
    add_homogenise_bench(bench, chosen);
    add_mesoscale_bench(bench, chosen);
    add_mortar_bench(bench, chosen);
    add_multiscale_bench(bench, chosen);
    add_peridynamics_bench(bench, chosen);
    add_sequential_bench(bench, chosen);
    add_quasi_static_bench(bench, chosen);
    add_ranks_bench(bench, chosen);
    add_rate_effect_bench(bench, chosen);
    add_size_effect_bench(bench, chosen);
    add_structure_bench(bench, chosen);
    add_surface_bench(bench, chosen);
    add_volume_bench(bench, chosen);
    add_uniaxial_bench(bench, chosen);
  }
} // namespace apps
