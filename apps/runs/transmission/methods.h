#pragma once

#include "coupling/transmission/wave_case.h"

#include <vector>

namespace apps
{
  /** All methods that a scene can name, the one for dynamics first. */
  const std::vector<coupling::WaveMethod> &wave_methods();
  /** Their names, for messages. */
  std::string wave_method_names();
} // namespace apps
