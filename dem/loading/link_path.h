#pragma once

#include "dem/laws/registry.h"

#include <array>
#include <string>
#include <vector>

namespace dem
{
  /** Total strains of one link, row by row. */
  struct LinkPath
  {
    std::vector<double>                normal; ///< [-], tension positive
    std::vector<std::array<double, 2>> shear;  ///< [-], two directions across the link; as many rows as normal
  };

  /** What the link answered: named columns with units, as many rows as the path, or as it could follow. */
  struct LinkHistory
  {
    struct Column
    {
      std::string         name, unit;
      std::vector<double> values;
    };
    std::vector<Column> columns;
    std::string         broke_off; ///< why rows are missing at its end; "": none is
  };

  /**
   * Drive one link of the law along the path.
   * @param per_second one over the time from row to row [1/s]; 0: none passes, and nothing depends on the rate
   */
  LinkHistory
  drive(const LinkLawKind &law, const LinkConstants &constants, const LinkPath &path, double per_second = 0);
} // namespace dem
