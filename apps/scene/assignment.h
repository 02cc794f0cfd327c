#pragma once

#include "apps/text/place.h"

#include <string>
#include <vector>

namespace apps
{
  /** "Sections/entry = value", and where it was written; without an entry, the opening of a section. */
  struct Assignment
  {
    std::vector<std::string> sections; ///< from the outermost
    std::string              entry;    ///< "": the section is opened here
    std::string              value;
    Place                    place;

    bool opens_section() const { return entry.empty(); }

    /** "Loading/Tension/Strain rate" */
    std::string path() const
    {
      std::string joined;
      for (const std::string &section : sections)
        joined += section + "/";
      return joined + entry;
    }
  };
} // namespace apps
