#pragma once

#include "apps/scene/section.h"

#include <string>
#include <vector>

namespace apps
{
  /** Order of names whose case does not matter. */
  struct OrderOfNames
  {
    bool operator()(const std::string &a, const std::string &b) const;
  };

  /** The names that a scene has for groups of particles; their case does not matter. */
  struct GroupNames
  {
    static constexpr const char *all = "all"; ///< always there

    std::vector<std::string> names = {all};

    bool knows(const std::string &name) const;
    /** @throws base::InputError where the value of an entry, a name, is none of them */
    void require(const Section &section, const std::string &entry, const std::string &name) const;
    /** The same for sub-sections that are named after groups. */
    void require_sections(const Section &sections) const;
  };
} // namespace apps
