#pragma once

#include "apps/models/material.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Materials and interfaces whose tensile strength lies beyond the apex of their envelope of shear, c / tan phi: they break in shear
   * before it is reached. A sentence for each.
   */
  std::vector<std::string> tension_beyond_apex(const MaterialSection &materials);

  /** The same as lines of `check`. */
  std::string lines_of_tension_beyond_apex(const MaterialSection &materials);
} // namespace apps
