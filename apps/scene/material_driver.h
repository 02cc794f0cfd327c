#pragma once

#include "fem/points/material_path.h"
#include "postprocess/files/csv_table.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Drive one point of a continuum along a table of strains [-] (strain_xx ... strain_xy, engineering shear) and stresses [Pa] (stress_xx ...);
   * a component without a column keeps zero strain.
   * @param material its name
   * @param constants of the material as "Entry=value" texts
   * @throws base::InputError naming the table, the entry or the row, and what is wrong with it
   */
  fem::MaterialHistory drive_point(const std::string              &material,
                                   const std::vector<std::string> &constants,
                                   const postprocess::CsvTable    &path);
} // namespace apps
