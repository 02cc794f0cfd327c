#pragma once

#include "apps/runs/particles/motion.h"

namespace apps
{
  class Section;

  void declare(Section &section, MotionFormulas &motion_formulas, const std::string &when);
  void declare(Section &section, PrescribedFormulas &prescribed);
  void declare(Section &root, PrescribedMotionSection &prescribed_motion);
} // namespace apps
