#pragma once

#include "dem/model/packing.h"

#include <string>

namespace apps
{
  /** The lines of a forecast that tell from where to where particles reach, surfaces included, and their radii: a file in millimetres shows. */
  std::string extent_lines(const dem::Packing &packing, int dimension);
} // namespace apps
