#pragma once

#include "apps/scene/assignment.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Everything that a parameter file (`.prm`, `.json`, or the page of a run, `.html`) sets, as deal.II's ParameterHandler reads it, in the file's
   * order.
   * @throws base::InputError with file and line when it cannot be read.
   */
  std::vector<Assignment> read_parameter_file(const std::string &file);
} // namespace apps
