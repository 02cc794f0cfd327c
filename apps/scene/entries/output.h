#pragma once

#include "apps/models/output.h"

namespace apps
{
  class Section;

  void declare(Section &root, OutputSection &output);

  /** The same of kinds whose particles ranks may share. */
  void declare_for_ranks(Section &root, OutputSection &output);
} // namespace apps
