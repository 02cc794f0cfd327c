#include "apps/runs/structure/outcome.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/structure/promotion.h"

namespace apps
{
  RunOutcome outcome(const StructureModel &model)
  {
    start_mpi();
    std::optional<dem::Packing> cell;
    const dem::Packing          packing = model.packing(&cell);
    const ParticleMedia         media   = model.media(cell);
    const Promotion             made(model, packing, media); // refuses what a run would refuse
    RunOutcome                  found;
    found.set_columns(made.structure().columns());
    for (const postprocess::SeriesColumn &column : made.structure().reported())
      found.add_figures_of_column(column.name);
    found.add_figures({"crack/links", "crack/cracked", "crack/area", "load_factor"});
    if (model.bending_test.evaluate())
      found.add_figures(BendingTestSection::names(model.gravity.acts()));
    if (model.wedge_splitting.evaluate())
      found.add_figures(WedgeSplittingSection::names());
    return found;
  }
} // namespace apps
