#include "coupling/multiscale/dealt_points.h"

#include <numeric>

namespace coupling
{
  DealtPoints::DealtPoints(const MPI_Comm given)
    : communicator(given)
  {
    int started = 0, count = 1, number = 0;
    MPI_Initialized(&started);
    if (started == 0)
      return;
    MPI_Comm_size(communicator, &count);
    MPI_Comm_rank(communicator, &number);
    ranks = static_cast<std::uint64_t>(count);
    rank  = static_cast<std::uint64_t>(number);
  }

  std::vector<base::Column> DealtPoints::shown(const base::Column &own) const
  {
    if (alone())
      return {own};
    const int        size = static_cast<int>(own.size());
    std::vector<int> sizes(ranks), starts(ranks, 0);
    MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
    std::partial_sum(sizes.begin(), sizes.end() - 1, starts.begin() + 1);
    std::vector<double> all(static_cast<std::size_t>(starts.back() + sizes.back()));
    MPI_Allgatherv(own.data(), size, MPI_DOUBLE, all.data(), sizes.data(), starts.data(), MPI_DOUBLE, communicator);
    std::vector<base::Column> of_ranks(ranks);
    for (std::size_t r = 0; r < ranks; ++r)
      of_ranks[r].assign(all.begin() + starts[r], all.begin() + starts[r] + sizes[r]);
    return of_ranks;
  }
} // namespace coupling
