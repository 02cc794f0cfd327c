#include "apps/process/path_solver.h"

#include "apps/process/mpi_session.h"

#include <fmt/format.h>

namespace apps
{
  void refuse_factor_on_ranks(const base::EntryPath &section, const dem::SolverMethod method)
  {
    if (rank_count() > 1 && method == dem::SolverMethod::direct)
      section.refuse("Linear solver", fmt::format("runs in one process, and mpirun has started {}. Choose automatic or "
                                                  "iterative, or use --threads.",
                                                  rank_count()));
  }
} // namespace apps
