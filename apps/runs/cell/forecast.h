#pragma once

#include "apps/runs/cell/model.h"

#include <string>

namespace apps
{
  /** What a run would take, as text for the terminal; writes nothing. @throws base::InputError for what a run would refuse */
  std::string forecast(const CellModel &model);
} // namespace apps
