#pragma once

#include "base/errors.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace fem
{
  /// Ends with `entry = value: broken rule` when the rule does not hold (NaN included).
  /// @throws base::InputError
  inline void demand(const bool holds, const std::string &entry, const double value, const std::string &rule)
  {
    if (holds)
      return;
    std::ostringstream text;
    text.precision(10);
    text << entry << " = " << value << ": " << rule;
    throw base::InputError(text.str());
  }
}
