#include "apps/runs/peridynamic_core/outcome.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/peridynamic_core/body.h"

namespace apps
{
  RunOutcome outcome(const PeridynamicCoreModel &model)
  {
    start_mpi();
    const auto body = make_peridynamic_core_body(model); // refuses what a run would refuse
    RunOutcome found;
    found.set_columns(body->columns());
    for (const postprocess::SeriesColumn &column : body->reported())
      found.add_figures_of_column(column.name);
    found.add_figures({"steps", "energy_balance_error", "handshake_spurious"});
    return found;
  }
} // namespace apps
