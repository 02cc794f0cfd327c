#pragma once

#include "apps/runs/peridynamic_core/model.h"

#include <string>

namespace apps
{
  /** What a run would take, as text for the terminal; writes nothing. @throws base::InputError for what a run would refuse */
  std::string forecast(const PeridynamicCoreModel &model);
} // namespace apps
