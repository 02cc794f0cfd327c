#pragma once

#include "apps/runs/particles/laboratory_section.h"

namespace apps
{
  class Section;

  void declare(Section &root, SpecimenTestSection &specimen_test);
} // namespace apps
