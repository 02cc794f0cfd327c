#include "apps/runs/particles/group_names.h"

#include "apps/text/nearest_name.h"
#include "apps/text/same_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace apps
{
  bool OrderOfNames::operator()(const std::string &a, const std::string &b) const
  {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](const char one, const char other) {
      return std::tolower(static_cast<unsigned char>(one)) < std::tolower(static_cast<unsigned char>(other));
    });
  }

  bool GroupNames::knows(const std::string &name) const
  {
    return std::any_of(names.begin(), names.end(), [&](const std::string &known) { return same_name(known, name); });
  }

  void GroupNames::require(const base::EntryPath &section, const std::string &entry, const std::string &name) const
  {
    if (!knows(name))
      section.refuse(entry, fmt::format("there is no such group. {} Groups: {}.", did_you_mean(name, names),
                                        fmt::join(names, ", ")));
  }

  void GroupNames::require_section(const base::EntryPath &sections, const std::string &name) const
  {
    if (!knows(name))
      sections.at(name).refuse(
        fmt::format("must be named after a group, and there is none of that name. {} Groups: {}.",
                    did_you_mean(name, names), fmt::join(names, ", ")));
  }
} // namespace apps
