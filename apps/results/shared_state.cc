#include "apps/results/shared_state.h"

#include "apps/process/mpi_session.h"
#include "base/errors.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <exception>

namespace apps
{
  namespace
  {
    using dealii::Utilities::MPI::all_gather;
    using dealii::Utilities::MPI::broadcast;
    using dealii::Utilities::MPI::gather;

    template <typename Values>
    void visit_parts(base::StateVisitor *inner, const bool reads, const std::string &name, Values &values)
    {
      using Plain = std::vector<typename Values::value_type>;
      Values whole;
      if (!reads)
        for (const Plain &part : gather(MPI_COMM_WORLD, Plain(values.begin(), values.end())))
          whole.insert(whole.end(), part.begin(), part.end());
      on_first_rank([&] { inner->column(name, whole); });
      if (!reads)
        return;
      const Plain all    = broadcast(MPI_COMM_WORLD, Plain(whole.begin(), whole.end()));
      std::size_t before = 0, total = 0;
      const auto  sizes = all_gather(MPI_COMM_WORLD, values.size());
      const auto  rank  = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      for (unsigned int r = 0; r < sizes.size(); ++r)
        {
          before += r < rank ? sizes[r] : 0;
          total += sizes[r];
        }
      if (total != all.size())
        throw base::InputError("checkpoint: \"" + name + "\" has " + std::to_string(all.size()) +
                               " values, and the model " + std::to_string(total) +
                               ". Another version wrote it: start again with --restart.");
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(before);
      values.assign(first, first + static_cast<std::ptrdiff_t>(values.size()));
    }

    /** From the first rank to all, at the same place in each. */
    void hand_on(void *values, std::size_t bytes)
    {
      constexpr std::size_t most = std::size_t(1) << 28; // MPI counts in int
      for (auto *at = static_cast<char *>(values); bytes > 0;)
        {
          const std::size_t part = std::min(bytes, most);
          MPI_Bcast(at, static_cast<int>(part), MPI_BYTE, 0, MPI_COMM_WORLD);
          at += part;
          bytes -= part;
        }
    }

    template <typename Value>
    void visit_scalar(base::StateVisitor *inner, const bool reads, const std::string &name, Value &value)
    {
      on_first_rank([&] { inner->scalar(name, value); });
      if (reads)
        value = broadcast(MPI_COMM_WORLD, value);
    }
  } // namespace

  SharedState::SharedState(RunState *on_first, const bool reads, const bool whole_on_each_rank)
    : inner(on_first)
    , reader(reads)
    , whole(whole_on_each_rank)
  {
  }

  template <typename Values>
  void SharedState::visit_column(const std::string &name, Values &values)
  {
    if (!whole)
      return visit_parts(inner, reader, name, values);
    on_first_rank([&] { inner->column(name, values); });
    if (!reader)
      return;
    values.resize(broadcast(MPI_COMM_WORLD, values.size()));
    hand_on(values.data(), values.size() * sizeof(typename Values::value_type));
  }

  void SharedState::group(const std::string &name)
  {
    on_first_rank([&] { inner->group(name); });
  }
  void SharedState::column(const std::string &name, base::Column &values) { visit_column(name, values); }
  void SharedState::column(const std::string &name, std::vector<std::int32_t> &values) { visit_column(name, values); }
  void SharedState::column_in_parts(const std::string &name, const std::size_t count, const Tell &tell)
  {
    bool               told = false;
    std::exception_ptr failed;
    const Take         leave = [](const double *, std::size_t) {};
    const auto hand_on = [&](const Take &take) { // the others wait for the first at each part, whatever happens to it
      told = true;
      tell([&](const double *const numbers, const std::size_t more) {
        try
          {
            if (!failed)
              take(numbers, more);
          }
        catch (...)
          {
            failed = std::current_exception();
          }
      });
      if (failed)
        std::rethrow_exception(failed);
    };
    try
      {
        if (inner)
          inner->column_in_parts(name, count, hand_on);
      }
    catch (...)
      {
        failed = std::current_exception();
      }
    if (!told)
      tell(leave);
    on_first_rank([&] {
      if (failed)
        std::rethrow_exception(failed);
    });
  }

  void SharedState::read_in_parts(const std::string &name, const Take &take)
  {
    std::exception_ptr failed;
    const auto         hand_count_on = [](std::size_t count) {
      hand_on(&count, sizeof(count));
      return count;
    };
    if (inner)
      {
        try
          {
            std::vector<double> part;
            inner->read_in_parts(name, [&](const double *const numbers, const std::size_t count) {
              part.assign(numbers, numbers + hand_count_on(count));
              hand_on(part.data(), part.size() * sizeof(double));
              take(part.data(), part.size());
            });
          }
        catch (...)
          {
            failed = std::current_exception();
          }
        hand_count_on(0); // the others wait for it
      }
    else
      {
        std::vector<double> part(hand_count_on(0));
        while (!part.empty())
          {
            hand_on(part.data(), part.size() * sizeof(double));
            take(part.data(), part.size());
            part.resize(hand_count_on(0));
          }
      }
    on_first_rank([&] {
      if (failed)
        std::rethrow_exception(failed);
    });
  }

  void SharedState::scalar(const std::string &name, double &value) { visit_scalar(inner, reader, name, value); }
  void SharedState::scalar(const std::string &name, std::int64_t &value) { visit_scalar(inner, reader, name, value); }
} // namespace apps
