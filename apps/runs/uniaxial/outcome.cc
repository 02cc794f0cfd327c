#include "apps/runs/uniaxial/outcome.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/lab_report.h"
#include "apps/runs/uniaxial/lab_test.h"

namespace apps
{
  RunOutcome outcome(const UniaxialModel &model)
  {
    RunOutcome found;
    found.figures = names_of_figures(model.loads(), true);
    if (model.emission.given())
      for (const UniaxialLoad load : model.loads())
        found.add_figures(EmissionFigures::names(std::string(name_of(load)) + "_"));
    if (model.fracture_zone)
      for (const UniaxialLoad load : model.loads())
        found.figures.push_back(std::string(name_of(load)) + "_fracture_zone_width");
    found.set_columns(UniaxialLabTest::series_columns(model));
    return found;
  }
} // namespace apps
