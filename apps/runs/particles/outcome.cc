#include "apps/runs/particles/outcome.h"

#include "apps/figures/emission_figures.h"
#include "apps/runs/particles/laboratory_report.h"

namespace apps
{
  RunOutcome outcome(const ParticlesModel &model)
  {
    RunOutcome found;
    for (const ProbeSection &probe : model.probes.probes)
      found.add_figures_of_column(probe.name);
    found.figures.emplace_back("broken_links");
    if (model.emission.given())
      found.add_figures(EmissionFigures::names());
    if (model.laboratory.given())
      for (const std::string &name : names_of_figures(model.laboratory))
        found.figures.push_back("laboratory/" + name);
    found.set_columns(model.columns());
    return found;
  }
} // namespace apps
