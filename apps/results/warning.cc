#include "apps/results/warning.h"

#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <cstdio>

namespace apps
{
  void warn_of_missing(const std::string &what, const std::string &problem)
  {
    if (!problem.empty())
      fmt::print(stderr, "breccia: warning: no {}: {}\n", what, problem);
  }

  void give_note(const std::string &text)
  {
    if (is_first_rank())
      fmt::print(stderr, "breccia: note: {}\n", text);
  }
} // namespace apps
