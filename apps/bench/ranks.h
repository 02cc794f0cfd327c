#pragma once

#include <filesystem>

namespace apps
{
  /** Options of `breccia bench ranks`. */
  struct RanksBench
  {
    std::filesystem::path folder;
    int                   cells    = 63;    ///< of the lattice along each edge, four particles in each: 1000188
    bool                  quick    = false; ///< 16 cells along each edge: 16384 particles
    bool                  on_paper = false; ///< instead: as many particles for each rank, up to 27 (ranks_on_paper.h)
    int                   memory_steps =
      0; ///< take so many steps, shared among the ranks that there are, and say what each takes up; 0: no
  };

  /**
   * What sums without loss cost beside plain ones, and how a cube of a face-centred cubic lattice of CPM links is shared out among 1 to 64 ranks:
   * copies, ghosts, neighbours, bytes and the efficiency that the model of doc/theory/ranks.md, 4 expects, for steps as fast as this process
   * takes them. Under mpirun instead: steps of the cube on the first rank alone, and then shared among all, beside what the model expects. With
   * memory_steps instead of both: shared steps alone, and the memory of each rank.
   *
   * Written to ranks.csv, ranks.md and ranks.png. @return exit status. @throws postprocess::OutputError
   */
  int run_ranks_bench(const RanksBench &bench);
} // namespace apps
