#pragma once

#include "apps/models/material.h"

namespace apps
{
  class Section;

  void declare(Section &section, LinkLaw &link_law);
  void declare(Section &section, MaterialInterface &material_interface, const std::list<NamedMaterial> &materials);
  /** @param inertia whether densities matter */
  void declare(Section &root, MaterialSection &material, bool inertia = true);
} // namespace apps
