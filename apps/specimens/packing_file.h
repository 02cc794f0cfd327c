#pragma once

#include "base/length_unit.h"
#include "dem/model/packing.h"

#include <optional>
#include <string>

namespace apps
{
  /**
   * postprocess::read_packing() for a scene: particles that look like millimetres read as metres are questioned, unless the file
   * or the scene says the unit.
   *
   * @throws base::InputError
   */
  dem::Packing packing_in_file(const std::string &file, const std::optional<base::LengthUnit> &unit);
} // namespace apps
