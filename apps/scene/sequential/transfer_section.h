#pragma once

#include "apps/runs/sequential/transfer_section.h"

namespace apps
{
  class Section;

  void declare(Section &root, TransferSection &transfer);
} // namespace apps
