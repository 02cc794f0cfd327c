#include "apps/runs/peridynamic_core/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/peridynamic_core/body.h"
#include "apps/runs/peridynamics/run.h"

#include <fmt/format.h>

namespace apps
{
  std::string forecast(const PeridynamicCoreModel &model)
  {
    start_mpi();
    const auto                body = make_peridynamic_core_body(model); // refuses what a run would refuse
    const PeridynamicCoreSize size = body->size();
    std::string               text =
      fmt::format("  elements     {}\n  unknowns     {}\n  nodes        {}\n  bonds        {}, {} broken "
                  "at the start\n",
                  size.elements, size.unknowns, size.nodes, size.bonds, body->core().bonds.broken());
    text +=
      fmt::format("  horizon      {:.6g} m, {:.4g} spacings\n", body->core().bonds.horizon(), model.core.horizon.ratio);
    text += "  " + lattice_lines(body->core().bonds, model.core.materials.names());
    text += fmt::format("  handshake    {} nodes of the core tied to {} of the mesh; {}\n", size.nodes_in_overlap,
                        size.mesh_nodes, body->text_of_mismatch());
    for (const std::string &doubt : body->doubts())
      text += "  warning      " + doubt + "\n";
    const double steps = model.end_time / body->step();
    text += fmt::format("  step         {:.4g} s: elements {:.4g} s, core {:.4g} s\n  steps        {:.0f}\n",
                        body->step(), size.solid_step, size.core_step, steps);
    try
      {
        return text + duration_line(steps * seconds_per_unit([&](const std::int64_t n) { return body->advance(n); }));
      }
    catch (const std::runtime_error &failure)
      {
        return text + fmt::format("  warning      the first steps fail: {}\n", failure.what());
      }
  }
} // namespace apps
