#pragma once

#include "apps/models/joints.h"

namespace apps
{
  class Section;

  /** Sub-section "Joints" of section "Specimen", which is there, and section "Joint materials". */
  void declare(Section &root, JointSection &joints);
} // namespace apps
