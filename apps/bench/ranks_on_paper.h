#pragma once

#include "apps/bench/ranks.h"

namespace apps
{
  /**
   * Cubes of a million particles for each rank, up to 27 of them (161 million links): how they would be shared out, whether a step would take as long as one
   * rank takes for a million (weak scaling, by the model of doc/theory/ranks.md, 4), and what memory a rank would need. Nothing is stepped but
   * one cube, for the time of an update and the bytes of a link and of a particle.
   *
   * Written to ranks_on_paper.csv, ranks_on_paper.md and ranks_on_paper.png. @return exit status. @throws postprocess::OutputError
   */
  int run_ranks_on_paper(const RanksBench &bench);
} // namespace apps
