#pragma once

#include "apps/runs/peridynamics/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, PeridynamicAnalysisSection &peridynamic_analysis);
  void declare(Section &root, PeridynamicsModel &model);
} // namespace apps
