#pragma once

#include "base/entry_path.h"

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
    void require(const base::EntryPath &section, const std::string &entry, const std::string &name) const;
    /** The same for a sub-section that is named after a group. */
    void require_section(const base::EntryPath &sections, const std::string &name) const;
  };
} // namespace apps
