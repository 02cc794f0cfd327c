#pragma once

#include "apps/scene/assignment.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * "Section/Key=value" texts of the command line (option -s) as assignments; later ones of the same key win.
   * @throws base::InputError for a text of another form.
   */
  std::vector<Assignment> read_overrides(const std::vector<std::string> &texts);
} // namespace apps
