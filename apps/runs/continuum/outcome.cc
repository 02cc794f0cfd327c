#include "apps/runs/continuum/outcome.h"

#include "apps/figures/contact_figures.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/run.h"

namespace apps
{
  namespace
  {
    template <int dim>
    RunOutcome outcome_of_solid(const ContinuumModel &model)
    {
      const ContinuumRun<dim> run(RunRequest{}, model); // refuses what a run would refuse
      RunOutcome              found;
      found.set_columns(run.series_columns());
      if (found.has_column("load_factor"))
        found.figures.emplace_back("peak_load_factor");
      for (const ProbeColumn &probe : run.probe_columns())
        {
          if (probe.reported == ProbeColumn::Reported::peak)
            found.figures.push_back("peak_" + probe.column.name);
          if (probe.reported == ProbeColumn::Reported::last)
            found.figures.push_back(probe.reported_as);
        }
      if (found.has_column("opening"))
        found.figures.emplace_back("final_opening");
      if (model.output.fracture_zone)
        found.figures.emplace_back("fracture_zone_width");
      if (!model.contacts.empty())
        found.add_figures(ContactFigures::names());
      if (model.is_static())
        found.add_figures(
          {"largest_principal_stress", "least_principal_stress", "largest_mises_stress", "largest_displacement"});
      return found;
    }
  } // namespace

  RunOutcome outcome(const ContinuumModel &model)
  {
    start_mpi();
    return model.solid.dimension == 2 ? outcome_of_solid<2>(model) : outcome_of_solid<3>(model);
  }
} // namespace apps
