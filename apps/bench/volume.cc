#include "apps/bench/volume.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/transmission/methods.h"
#include "apps/runs/transmission/model.h"
#include "apps/runs/transmission/report.h"

#include <fmt/format.h>

#include <cstdio>

namespace apps
{
  namespace
  {
    void write_waves(const BenchResults &results, const std::vector<WavePoint> &rows)
    {
      std::string csv = "method,wavelength [m],reflected [-],transmitted [-],absorbed [-],made [-],cost of a step "
                        "[-],steps,unhindered [-]\n";
      std::string md = "| Method | Wavelength [m] | Reflected | Transmitted | Absorbed | Made | Cost of a step | Steps "
                       "| Unhindered |\n"
                       "|---|---|---|---|---|---|---|---|---|\n";
      for (const WavePoint &r : rows)
        {
          const coupling::WaveAnswer &a = r.answer;
          csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.method, r.wavelength, a.reflected, a.transmitted,
                             a.absorbed, a.made, a.cost, a.steps, a.unhindered);
          md +=
            fmt::format("| {} | {:.4g} | {:.4f} | {:.4f} | {:.4f} | {:.1e} | {:.2f} | {} | {:.4f} |\n", r.method,
                        r.wavelength, a.reflected, a.transmitted, a.absorbed, a.made, a.cost, a.steps, a.unhindered);
        }
      results.write(csv, md);
    }
  } // namespace

  int run_volume_bench(const VolumeBench &bench)
  {
    start_mpi();
    const CheckedScene requested = read_scene(bench.scene, bench.overrides);
    const auto        &scene     = model_of_kind<TransmissionModel>(requested, "transmission");
    const BenchResults results(bench.folder, "volume");
    catch_interrupts();
    std::vector<double> lengths = scene.wavelengths;
    if (bench.quick && lengths.size() > 2)
      lengths = {lengths.front(), lengths[lengths.size() / 2]};
    std::vector<WavePoint> rows;
    for (const coupling::WaveMethod &method : wave_methods())
      for (const double length : lengths)
        {
          rows.push_back({method.name, length, coupling::transmit(scene.wave(method, length))});
          if (interrupted())
            return exit_interrupted; // the table has every complete case
          const coupling::WaveAnswer &a = rows.back().answer;
          fmt::print("{:<14} {:<10.4g} m: reflected {:.4f}, transmitted {:.4f}, absorbed {:.4f}, a step costs {:.2f}\n",
                     method.name, length, a.reflected, a.transmitted, a.absorbed, a.cost);
          std::fflush(stdout);
          write_waves(results, rows);
        }
    return results.finish(wave_panels(rows, scene.wave(wave_methods().front(), lengths.front())));
  }
} // namespace apps
