#pragma once

namespace dem
{
  class Specimen;
}

namespace apps
{
  /** Let the processes that mpirun has started share the work of a specimen that each of them has made; one process goes on alone. */
  void share_among_ranks(dem::Specimen &specimen);
} // namespace apps
