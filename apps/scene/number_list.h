#pragma once

#include "apps/scene/section.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Declare a text of numbers between commas (and semicolons), e.g. sizes with their fractions, strains, or corners. Unusual sizes are questioned as those of single numbers are
   * (usual_sizes.h), and each may name its unit, which the member then does not have.
   */
  Entry &
  declare_list(Section &section, const std::string &entry, std::string &member, const std::string &unit, Need need);

  /** Declare numbers between commas, likewise. @param expected what they may be, for messages: "strains above 0" */
  Entry &declare_numbers(Section             &section,
                         const std::string   &entry,
                         std::vector<double> &member,
                         const std::string   &unit,
                         const std::string   &expected,
                         Need                 need);

  /** Declare names between commas. */
  Entry &declare_names(Section &section, const std::string &entry, std::vector<std::string> &member, Need need);
} // namespace apps
