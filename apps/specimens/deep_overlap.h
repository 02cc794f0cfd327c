#pragma once

#include <string>

namespace apps
{
  /**
   * What casts doubt on a run in which particles were pressed deep into each other, for summary and terminal.
   * @param deepest as dem::Counts says, over the smaller radius [-] @return "" if there is no doubt
   */
  std::string overlap_warning(double deepest);
  /** The same of particles that turned far in a step. @param largest as dem::Counts says [rad] */
  std::string turn_warning(double largest);
} // namespace apps
