#pragma once

#include "apps/runs/continuum/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, SolidSection &solid);
  void declare(Section &root, ControlSection &control, std::function<bool()> is_static);
  void declare(Section &root, MotionSection &motion, std::function<bool()> is_explicit);
  void declare(Section &root, ContinuumOutputSection &continuum_output, std::function<bool()> is_explicit);
  void declare(Section &root, ContinuumModel &model);
  /** All of them but what couples with other programs: of a solid that goes on from something else. */
  void declare_alone(Section &root, ContinuumModel &model);
  /** The sections of a solid that moves together with something else: the scene says where that ends and what is written. */
  void declare_as_part(Section &root, ContinuumModel &model);
  /** Those of a solid in equilibrium with something else. @param weighs whether its weight acts */
  void declare_as_static_part(Section &root, ContinuumModel &model, std::function<bool()> weighs);
} // namespace apps
