#include "apps/runs/uniaxial/outcome.h"

#include "apps/figures/lab_report.h"
#include "apps/runs/uniaxial/lab_test.h"

namespace apps
{
  RunOutcome outcome(const UniaxialModel &model)
  {
    RunOutcome found;
    found.figures = names_of_figures(model.loads(), true);
    found.set_columns(UniaxialLabTest::series_columns(model));
    return found;
  }
} // namespace apps
