#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace fem
{
  /// Ends with `entry = value: broken rule` when the rule does not hold (NaN included).
  /// @throws std::invalid_argument
  inline void demand(const bool holds, const std::string &entry, const double value, const std::string &rule)
  {
    if (holds)
      return;
    std::ostringstream text;
    text.precision(10);
    text << entry << " = " << value << ": " << rule;
    throw std::invalid_argument(text.str());
  }
}
