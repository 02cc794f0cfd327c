#include "apps/process/mpi_ranks.h"

#include "apps/process/mpi_session.h"
#include "apps/process/rank_meetings.h"
#include "dem/ranks/ranks.h"
#include "dem/specimen/specimen.h"

#include <mpi.h>

#include <limits>
#include <stdexcept>

namespace apps
{
  namespace
  {
    /** Messages of a step; none other is under way when they are. */
    constexpr int tag = 1;

    class MpiRanks : public dem::Ranks
    {
    public:
      MpiRanks()
      {
        int number = 0, count = 1;
        MPI_Comm_rank(MPI_COMM_WORLD, &number);
        MPI_Comm_size(MPI_COMM_WORLD, &count);
        self = static_cast<std::size_t>(number);
        all  = static_cast<std::size_t>(count);
      }

      std::size_t rank() const override { return self; }
      std::size_t size() const override { return all; }

      void largest(double *numbers, const std::size_t count) override
      {
        meet("largest of numbers", count);
        MPI_Allreduce(MPI_IN_PLACE, numbers, static_cast<int>(count), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
      }

      void gather(void *array, const std::vector<std::size_t> &begin) override
      {
        meet("gather", begin.back());
        std::vector<int> counts(all), places(all);
        for (std::size_t r = 0; r < all; ++r)
          {
            places[r] = in_units(begin[r]);
            counts[r] = in_units(begin[r + 1]) - places[r];
          }
        MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, array, counts.data(), places.data(), MPI_DOUBLE,
                       MPI_COMM_WORLD);
      }

      void exchange(const std::vector<dem::RankMessage> &sent, std::vector<dem::RankMessage> &received) override
      {
        meet("exchange");
        std::vector<MPI_Request> requests;
        for (dem::RankMessage &message : received)
          MPI_Irecv(message.numbers.data(), static_cast<int>(message.numbers.size()), MPI_DOUBLE,
                    static_cast<int>(message.rank), tag, MPI_COMM_WORLD, &requests.emplace_back());
        for (const dem::RankMessage &message : sent)
          MPI_Isend(message.numbers.data(), static_cast<int>(message.numbers.size()), MPI_DOUBLE,
                    static_cast<int>(message.rank), tag, MPI_COMM_WORLD, &requests.emplace_back());
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
      }

      std::vector<std::vector<std::int32_t>> deliver(const std::vector<std::vector<std::int32_t>> &lists) override
      {
        meet("deliver");
        std::vector<int>          sizes(all), places(all), sizes_here(all), places_here(all);
        std::vector<std::int32_t> flat;
        for (std::size_t r = 0; r < all; ++r)
          {
            places[r] = static_cast<int>(flat.size());
            sizes[r]  = static_cast<int>(lists[r].size());
            flat.insert(flat.end(), lists[r].begin(), lists[r].end());
          }
        MPI_Alltoall(sizes.data(), 1, MPI_INT, sizes_here.data(), 1, MPI_INT, MPI_COMM_WORLD);
        int total = 0;
        for (std::size_t r = 0; r < all; ++r)
          {
            places_here[r] = total;
            total += sizes_here[r];
          }
        std::vector<std::int32_t> here(static_cast<std::size_t>(total));
        MPI_Alltoallv(flat.data(), sizes.data(), places.data(), MPI_INT32_T, here.data(), sizes_here.data(),
                      places_here.data(), MPI_INT32_T, MPI_COMM_WORLD);
        std::vector<std::vector<std::int32_t>> received(all);
        for (std::size_t r = 0; r < all; ++r)
          received[r].assign(here.begin() + places_here[r], here.begin() + places_here[r] + sizes_here[r]);
        return received;
      }

    private:
      /** MPI counts in int: all that is gathered is made of doubles, or padded to some. */
      static int in_units(const std::size_t bytes)
      {
        const std::size_t units = bytes / sizeof(double);
        if (bytes % sizeof(double) != 0 || units > std::numeric_limits<int>::max())
          throw std::length_error("ranks: one column of 16 GiB or more cannot be gathered");
        return static_cast<int>(units);
      }

      std::size_t self, all;
    };
  } // namespace

  std::shared_ptr<dem::Ranks> launched_team() { return rank_count() > 1 ? std::make_shared<MpiRanks>() : nullptr; }

  void share_among_ranks(dem::Specimen &specimen)
  {
    if (const std::shared_ptr<dem::Ranks> team = launched_team())
      specimen.share_among(team);
  }
} // namespace apps
