#pragma once

#include "apps/scene/assignment.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Give assignments to sections and entries that had another name in the last version their present names. Old names are read for one
   * version, those listed in renamed.cc; then their lines go.
   * @return a note for each old name, with the first place where it is written
   */
  std::vector<std::string> use_present_names(std::vector<Assignment> &assignments);
} // namespace apps
