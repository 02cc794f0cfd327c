#pragma once

#include "apps/scene/section.h"

#include <array>
#include <string>
#include <vector>

namespace apps
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
    std::vector<std::string>         names; ///< "stress_xx [Pa]"
    std::vector<std::vector<double>> rows;

    /** As CSV: a header line with units, numbers in the shortest form that keeps every bit. */
    std::string as_csv() const;
  };

  /** A material that can be driven alone. */
  struct DrivenMaterial
  {
    std::string name;
    /**
     * Declare the constants in the section, let `read` fill them, and drive one point along the path, straight from row to row.
     * @throws dem::InputError naming the row that could not be reached, and how far it could.
     */
    MaterialHistory (*drive)(Section &constants, const std::function<void()> &read, const MaterialPath &path);
  };

  /** Every material of `breccia point-test`; a new one is one line in material_path.cc. */
  const std::vector<DrivenMaterial> &driven_materials();
} // namespace apps
