#pragma once

#include "dem/model/packing.h"
#include "postprocess/packings/packing_io.h"

#include <filesystem>
#include <string>

namespace postprocess
{
  /** Whether a file is one for YADE by its name: .yade */
  bool is_named_yade(const std::filesystem::path &path);

  /**
   * Text as export.textExt of YADE writes it and its ymport.textExt reads it: `#format x_y_z_r`, or `x_y_z_r_matId` where there are materials, with
   * their numbers. Cell, names of materials and metadata stand in comments, which YADE passes over.
   * @throws base::InputError for rigid bodies, and for a packing that is periodic along some edges alone
   */
  std::string packing_as_yade(const dem::Packing &packing, const Metadata &metadata);
} // namespace postprocess
