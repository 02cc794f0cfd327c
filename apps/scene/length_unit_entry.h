#pragma once

#include "apps/scene/section.h"
#include "base/length_unit.h"

#include <optional>

namespace apps
{
  /** Entry "Length unit" of a packing: empty where the scene leaves it to the file. */
  Entry &declare_packing_unit(Section &section, std::optional<base::LengthUnit> &unit);

  /** The same of a mesh, whose file cannot say it: empty where the scene does not say it either. */
  Entry &declare_mesh_unit(Section &section, std::optional<base::LengthUnit> &unit);
} // namespace apps
