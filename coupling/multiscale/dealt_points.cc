#include "coupling/multiscale/dealt_points.h"

#include "base/flat_state.h"

#include <numeric>
#include <stdexcept>

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

  void DealtPoints::require_one_group() const
  {
    int length = static_cast<int>(of_group.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
    std::string of_first = of_group;
    of_first.resize(static_cast<std::size_t>(length));
    MPI_Bcast(of_first.data(), length, MPI_CHAR, 0, communicator);
    int differs = of_first != of_group ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &differs, 1, MPI_INT, MPI_MAX, communicator);
    if (differs != 0)
      throw std::logic_error("ranks exchange points of different groups; this one those of \"" + of_group + "\"");
  }

  std::vector<base::Column> DealtPoints::shown(const base::Column &own) const
  {
    if (alone())
      return {own};
    require_one_group();
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

  void DealtPoints::share(const std::vector<std::size_t> &own, const OfPoint &visit) const
  {
    if (alone())
      return;
    base::Column          row;
    base::FlatStateWriter writer(row);
    for (const std::size_t point : own)
      {
        row.push_back(static_cast<double>(point));
        visit(point, writer);
      }
    for (const base::Column &of_rank : shown(row))
      {
        base::FlatStateReader reader(of_rank);
        while (reader.position() < of_rank.size())
          {
            std::int64_t point = 0;
            reader.scalar("point", point);
            visit(static_cast<std::size_t>(point), reader);
          }
      }
  }

  void visit_text(base::StateVisitor &visitor, const std::string &name, std::string &text)
  {
    std::vector<std::int32_t> letters(text.begin(), text.end());
    visitor.column(name, letters);
    text.assign(letters.begin(), letters.end());
  }
} // namespace coupling
