#pragma once

#include "apps/models/material_region.h"

namespace apps
{
  class Section;

  void declare(Section &section, MaterialRegion &material_region);
  /** Entries that name the two materials of an interface. @param between "links between its own particles" */
  void declare_pair(Section &section, std::string &one, std::string &other, const std::string &between);
  /** Section "Regions". @param of "particles" or "nodes" */
  void declare_regions(Section &root, std::list<MaterialRegion> &regions, const std::string &of);
} // namespace apps
