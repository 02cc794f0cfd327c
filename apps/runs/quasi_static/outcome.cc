#include "apps/runs/quasi_static/outcome.h"

#include "apps/figures/lab_report.h"
#include "apps/runs/quasi_static/lab_test.h"

namespace apps
{
  RunOutcome outcome(const QuasiStaticModel &model)
  {
    RunOutcome found;
    found.figures = names_of_figures(model.loads(), !model.is_cell());
    found.set_columns(QuasiStaticLabTest::series_columns(model));
    return found;
  }
} // namespace apps
