#pragma once

#include "apps/runs/particles/published_figures.h"

namespace apps
{
  class Section;

  /** @param test whether there is one */
  void declare(Section &laboratory, PublishedFigures &published_figures, const std::function<bool()> &test);
} // namespace apps
