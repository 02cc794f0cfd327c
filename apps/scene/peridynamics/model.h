#pragma once

#include "apps/runs/peridynamics/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, PeridynamicAnalysisSection &analysis);
  void declare(Section &root, PeridynamicsModel &model);
  /** Of a body that moves together with something else. */
  void declare_as_part(Section &root, PeridynamicAnalysisSection &analysis);
  /** The sections of a body that moves together with something else: the scene says where that ends, what is written, and how fast it is at the start. */
  void declare_as_part(Section &root, PeridynamicsModel &model);
} // namespace apps
