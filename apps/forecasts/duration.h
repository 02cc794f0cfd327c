#pragma once

#include "base/stopwatch.h"
#include "dem/specimen/observation.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace apps
{
  /**
   * Seconds of one unit of work, from as many as fit into about half a second.
   * @param work does so many of them, or fewer where there are no more @return how many it did
   */
  double seconds_per_unit(const std::function<std::int64_t(std::int64_t)> &work);

  /** The same of time steps. @param advance takes so many steps, or fewer where its test ends */
  double seconds_per_step(const dem::ObservedSpecimen &body, const std::function<void(std::int64_t)> &advance);

  /** Seconds that a forecast says: the first "roughly 3:07 min" of its lines; nothing where none does. */
  std::optional<double> duration_in(const std::string &forecast);

  /** The line of a forecast. @param at_most [s]; 0: nothing is known of it */
  std::string duration_line(double expected, double at_most = 0);
} // namespace apps
