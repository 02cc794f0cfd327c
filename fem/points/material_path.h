#pragma once

#include "fem/points/registry.h"

#include <array>
#include <string>
#include <vector>

namespace fem
{
  /** What is prescribed of a material point, row by row: each component in strain or in stress. */
  struct MaterialPath
  {
    std::array<bool, 6>                stress_given{}; ///< order xx yy zz yz zx xy
    std::vector<std::array<double, 6>> rows;           ///< strain [-], engineering shear, or stress [Pa]
    std::string                        origin;         ///< the file, for messages
  };

  /** What the point answered: named columns with units, as many rows as the path. */
  struct MaterialHistory
  {
    std::vector<std::string>         names, units; ///< of the columns
    std::vector<std::vector<double>> rows;
  };

  /**
   * Drive one point of a material along the path, straight from row to row.
   * @throws base::InputError for constants without meaning, and naming the row that could not be reached, and how far it could.
   */
  MaterialHistory drive(const MaterialConstants &constants, const MaterialPath &path);
} // namespace fem
