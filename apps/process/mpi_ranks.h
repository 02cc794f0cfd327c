#pragma once

#include <memory>

namespace dem
{
  class Ranks;
  class Specimen;
} // namespace dem

namespace apps
{
  /** The processes that mpirun has started; null for one alone. @pre start_mpi_for_ranks() */
  std::shared_ptr<dem::Ranks> launched_team();

  /** Let the processes that mpirun has started share the work of a specimen that each of them has made; one process goes on alone. */
  void share_among_ranks(dem::Specimen &specimen);
} // namespace apps
