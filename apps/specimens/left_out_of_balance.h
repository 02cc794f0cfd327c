#pragma once

#include "dem/model/link_law.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * What the energy account of particles misses by the law of their links (doc/theory/shear-kinematics.md, 3): for summary and terminal.
   * @param radius of the particles that may be linked [m] @return "" if nothing
   */
  std::string left_out_of_balance(const dem::LinkLaw &law, const std::vector<double> &radius);

  /** Its line on the terminal; "" if there is nothing to say. */
  std::string balance_note(const std::string &left_out);
} // namespace apps
