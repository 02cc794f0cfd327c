#include "apps/results/warning.h"

#include <fmt/format.h>

#include <cstdio>

namespace apps
{
  void warn_of_missing(const std::string &what, const std::string &problem)
  {
    if (!problem.empty())
      fmt::print(stderr, "breccia: warning: no {}: {}\n", what, problem);
  }
} // namespace apps
