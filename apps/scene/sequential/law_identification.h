#pragma once

#include "apps/runs/sequential/law_identification.h"

namespace apps
{
  class Section;

  void declare(Section &transfer, IdentificationSection &identification, const TransferSection &law);
} // namespace apps
