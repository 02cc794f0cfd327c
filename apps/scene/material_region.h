#pragma once

#include "apps/scene/region.h"

#include <string>

namespace apps
{
  /** Sub-section of "Regions": particles whose centre lies within are of its material. */
  struct MaterialRegion
  {
    std::string name, material;
    Region      region;

    void declare(Section &section)
    {
      section.text("Material", material, Need::required).means("Name of a section in Materials");
      region.declare(section);
    }
  };
} // namespace apps
