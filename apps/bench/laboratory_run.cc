#include "apps/bench/laboratory_run.h"

#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  double value_of(const dem::Finding &finding) { return finding.found ? finding.value : unknown_figure; }

  std::string in_table(const double value, const double unit, const char *digits)
  {
    return std::isnan(value) ? "-" : fmt::format(fmt::runtime(digits), value / unit);
  }

  std::string in_csv(const double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

  LaboratoryRun run_test(ParticlesBody &body, const double end_time)
  {
    LaboratoryRun run;
    const double  start = base::processor_seconds();
    while (!body.test_is_over() && body.specimen().time() < end_time)
      {
        body.advance(1000);
        run.balance = std::max(run.balance, body.specimen().energy().balance_error());
      }
    run.cost = base::processor_seconds() - start;
    return run;
  }
} // namespace apps
