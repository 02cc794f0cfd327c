#pragma once

#include "apps/models/joints.h"

namespace apps
{
  class Section;

  /** Sub-section "Joints". @param specimen section */
  void declare(Section &specimen, JointSection &joints);
} // namespace apps
