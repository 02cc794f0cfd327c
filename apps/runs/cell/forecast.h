#pragma once

#include "apps/runs/cell/model.h"

#include <cstddef>
#include <string>

namespace apps
{
  /**
   * What a run would take, as text for the terminal; writes nothing. @param ranks among which it is to say how particles would be shared out; 0:
   * it says nothing of that @throws base::InputError for what a run would refuse
   */
  std::string forecast(const CellModel &model, std::size_t ranks = 0);
} // namespace apps
