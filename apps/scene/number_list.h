#pragma once

#include "apps/scene/section.h"

#include <string>

namespace apps
{
  /**
   * Declare a text of numbers between commas (and semicolons), e.g. sizes with their fractions, strains, or corners. They are asked about as single numbers are
   * (usual_sizes.h), and each may name its unit, which the member then does not have.
   */
  Entry &
  declare_list(Section &section, const std::string &entry, std::string &member, const std::string &unit, Need need);
} // namespace apps
