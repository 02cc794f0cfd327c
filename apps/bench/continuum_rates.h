#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace apps
{
  /** How fast one operation runs on one rank, by Breccia and by a plain deal.II program. */
  struct ContinuumRate
  {
    std::string operation; ///< assembly, product, solver iteration, whole solution, explicit step
    std::size_t unknowns = 0;
    double      ours = 0, plain = 0; ///< [s] of processor, once

    double per_second(const double seconds) const { return static_cast<double>(unknowns) / seconds; }
  };

  /** Trilinear hexahedra, elastic; best of several repeats. */
  std::vector<ContinuumRate> measure_rates(unsigned int divisions);

  /** Figures that depend on the number of ranks. */
  struct RankFigures
  {
    int         ranks    = 1;
    std::size_t unknowns = 0, elements = 0;
    double      mesh = 0, set_up = 0, solution = 0; ///< of the large static problem [s], wall clock, slowest rank
    std::string solver;
    double      updates = 0; ///< of integration points, explicit steps, per second and core (wall clock)
    double      kernel  = 0; ///< the same of the internal force alone
  };

  /** Static problem and explicit motion of a cube of divisions^3 elements over all ranks. */
  RankFigures measure_on_ranks(unsigned int divisions, MPI_Comm communicator);
} // namespace apps
