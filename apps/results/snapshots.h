#pragma once

#include "apps/results/run_state.h"
#include "postprocess/vtk/pvd.h"

#include <optional>

namespace apps
{
  /**
   * The list of snapshots in a checkpoint of a run in one process. A run may be resumed with more snapshots, fewer, or none.
   * @throws postprocess::OutputError when the list cannot be written anew.
   */
  inline void visit_snapshots(RunState &state, const char *group, std::optional<postprocess::PvdCollection> &snapshots)
  {
    base::Column times;
    if (snapshots)
      times = snapshots->listed();
    state.group(group);
    state.column("times", times);
    if (state.reads() && snapshots)
      snapshots->restore(times);
  }
} // namespace apps
