#include "apps/drivers/particles/group_names.h"

#include "apps/scene/nearest_name.h"
#include "apps/scene/same_name.h"

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

  void GroupNames::require(const Section &section, const std::string &entry, const std::string &name) const
  {
    if (!knows(name))
      section.refuse(entry, fmt::format("there is no such group. {} Groups: {}.", did_you_mean(name, names),
                                        fmt::join(names, ", ")));
  }

  void GroupNames::require_sections(const Section &sections) const
  {
    for (const auto &section : sections.sections())
      if (!knows(section->name()))
        throw base::InputError(fmt::format("{}: section \"{}\" must be named after a group, and there is none of that "
                                           "name. {} Groups: {}.",
                                           section->place().text(), section->path(),
                                           did_you_mean(section->name(), names), fmt::join(names, ", ")));
  }
} // namespace apps
