#pragma once

#include "apps/models/specimen.h"

namespace apps
{
  class Section;

  /** @param dimension chosen in section "Physics"; read only after reading. */
  void declare(Section &root, SpecimenSection &specimen, const int &dimension, const SpecimenSection::Use &use);
} // namespace apps
