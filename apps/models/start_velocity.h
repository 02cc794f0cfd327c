#pragma once

#include "apps/text/vector_formula.h"
#include "base/entry_path.h"

#include <string>

namespace apps
{
  /**
   * That velocities at the start do not vary in time, neither by a formula of t nor by a table.
   * @param quantity the entries are "QUANTITY x", "QUANTITY y" and "QUANTITY z", or "x", "y" and "z" where it is ""
   * @throws base::EntryError.
   */
  void refuse_time(const base::EntryPath &section, const std::string &quantity, const Expressions &velocity);
} // namespace apps
