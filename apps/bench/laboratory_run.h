#pragma once

#include "apps/runs/particles/body.h"

#include <limits>
#include <string>

namespace apps
{
  constexpr double unknown_figure = std::numeric_limits<double>::quiet_NaN();

  /** NaN where it was not found. */
  double value_of(const dem::Finding &finding);
  /** For a table, in a unit; "-" where it is not known. @param digits format of the value, e.g. "{:.3f}" */
  std::string in_table(double value, double unit, const char *digits);
  /** Empty where it is not known. */
  std::string in_csv(double value);

  /** What a laboratory's test took. */
  struct LaboratoryRun
  {
    double balance = 0; ///< largest error of the energies' balance on the way [-]
    double cost    = 0; ///< processor time [s]
  };

  /** From the start to the test's end, or the scene's. */
  LaboratoryRun run_test(ParticlesBody &body, double end_time);
} // namespace apps
