#pragma once

#include "base/entry_path.h"
#include "dem/linear/solver_method.h"

namespace apps
{
  /** @param section that has the entry "Linear solver" @throws base::InputError for a direct one, which makes a factor, where mpirun has started several processes */
  void refuse_factor_on_ranks(const base::EntryPath &section, dem::SolverMethod method);
} // namespace apps
