#pragma once

#include "apps/scene/section.h"
#include "dem/specimen/specimen.h"

namespace apps
{
  /** Section "Physics": what is modelled; what is off costs neither time nor memory. */
  void declare_physics(Section &root, dem::Physics &physics);
} // namespace apps
