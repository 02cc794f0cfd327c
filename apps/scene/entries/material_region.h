#pragma once

#include "apps/models/material_region.h"

namespace apps
{
  class Section;

  void declare(Section &section, MaterialRegion &material_region);
  /** Section "Regions". @param of "particles" or "nodes" */
  void declare_regions(Section &root, std::list<MaterialRegion> &regions, const std::string &of);
} // namespace apps
