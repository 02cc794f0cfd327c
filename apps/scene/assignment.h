#pragma once

#include "apps/scene/place.h"

#include <string>
#include <vector>

namespace apps
{
  /** "Sections/entry = value", and where it was written. */
  struct Assignment
  {
    std::vector<std::string> sections; ///< from the outermost
    std::string              entry;
    std::string              value;
    Place                    place;

    /** "Material/CPM/Cohesion" */
    std::string path() const
    {
      std::string joined;
      for (const std::string &section : sections)
        joined += section + "/";
      return joined + entry;
    }
  };
} // namespace apps
