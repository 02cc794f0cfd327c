#pragma once

#include "postprocess/files/numeric_text.h"

#include <cstddef>
#include <string>
#include <vector>

namespace postprocess
{
  /** What a legend says of the largest value: "peak Y at X"; "largest Y at X" where the curve begins or ends there. */
  inline std::string peak_words(const std::vector<double> &x, const std::vector<double> &y, const std::size_t largest)
  {
    return std::string(largest == 0 || largest + 1 == y.size() ? "largest " : "peak ") +
           numeric_text::rounded(y[largest]) + " at " + numeric_text::rounded(x[largest]);
  }
} // namespace postprocess
