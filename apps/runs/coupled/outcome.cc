#include "apps/runs/coupled/outcome.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/lab_report.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/coupled/body.h"

namespace apps
{
  RunOutcome outcome(const CoupledModel &model)
  {
    start_mpi();
    std::optional<dem::Packing> cell;
    const dem::Packing          packing = model.packing(&cell);
    const ParticleMedia         media   = model.media(cell);
    const auto                  body    = make_coupled_body(model, packing, media); // refuses what a run would refuse
    RunOutcome                  found;
    found.set_columns(body->columns());
    for (const postprocess::SeriesColumn &column : body->reported())
      found.add_figures_of_column(column.name);
    if (model.laboratory.given())
      found.add_figures(names_of_figures({UniaxialLoad::compression}, true));
    found.figures.emplace_back("broken_links");
    if (model.particles.emission.given())
      found.add_figures(EmissionFigures::names());
    for (const CouplingSection &coupling : model.couplings.couplings)
      if (coupling.bond.given())
        found.figures.push_back("torn_off/" + coupling.name);
    found.add_figures(ContactFigures::names());
    return found;
  }
} // namespace apps
