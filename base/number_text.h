#pragma once

#include <cstdio>
#include <string>

namespace base
{
  /// A number as a message shows it: six significant digits, of any size (std::to_string writes 1e300 with 301 digits, 1e-7 as zero).
  inline std::string number_text(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }
}
