#pragma once

#include "apps/scene/section.h"
#include "dem/specimen/specimen.h"

namespace apps
{
  /** Section "Physics": what is modelled; what is off costs neither time nor memory. */
  void declare_physics(Section &root, dem::Physics &physics);
  /** The same of particles in equilibrium. */
  void declare_static_physics(Section &root, int &dimension, bool &rotations);
} // namespace apps
