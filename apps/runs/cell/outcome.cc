#include "apps/runs/cell/outcome.h"

#include "apps/runs/cell/run.h"
#include "base/voigt.h"

#include <fmt/format.h>

#include <iterator>

namespace apps
{
  RunOutcome outcome(const CellModel &)
  {
    RunOutcome found;
    found.figures = {"end/time"};
    for (const char *vector : {"largest_stress/value", "least_stress/value", "end/strain", "end/stress"})
      for (std::size_t k = 0; k < std::size(base::voigt_names); ++k)
        found.figures.push_back(fmt::format("{}/{}", vector, k));
    found.set_columns(CellRun::columns_of_series());
    return found;
  }
} // namespace apps
