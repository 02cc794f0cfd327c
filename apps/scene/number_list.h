#pragma once

#include "apps/scene/section.h"

#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * Declare a list of numbers in a form of its own, e.g. sizes with their fractions, or corners. Unusual sizes are questioned as those of
   * single numbers are (usual_sizes.h), and each may name its unit.
   * @param read takes the text, without units, into the model; what it throws as base::InputError is the message
   */
  Entry &declare_list(Section                                 &section,
                      const std::string                       &entry,
                      std::function<void(const std::string &)> read,
                      const std::string                       &unit,
                      Need                                     need);

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
