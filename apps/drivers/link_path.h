#pragma once

#include "apps/scene/section.h"

#include <string>
#include <vector>

namespace apps
{
  /** Total strains of one link, row by row. */
  struct LinkPath
  {
    std::vector<double>                normal; ///< [-], tension positive
    std::vector<std::array<double, 2>> shear;  ///< [-], two directions across the link; as many rows as normal
  };

  /** What the link answered: named columns with units, as many rows as the path. */
  struct LinkHistory
  {
    struct Column
    {
      std::string         name, unit;
      std::vector<double> values;
    };
    std::vector<Column> columns;

    /** As CSV: a header line with units, numbers in the shortest form that keeps every bit. */
    std::string as_csv() const;
  };

  /** A link law that can be driven alone: how its constants are declared, and how it answers a path. */
  struct DrivenLaw
  {
    std::string name;
    /** Declare the constants in the section, let `read` fill them, and drive one link along the path. */
    LinkHistory (*drive)(Section &constants, const std::function<void()> &read, const LinkPath &path);
  };

  /** Every law of `breccia link-test`; a new one is one line in link_path.cc. */
  const std::vector<DrivenLaw> &driven_laws();
} // namespace apps
