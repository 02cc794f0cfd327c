#pragma once

#include "apps/results/run_state.h"

#include <functional>

namespace apps
{
  /**
   * State of several ranks, as one state of the first rank: what a checkpoint stores and gives back.
   *
   * Columns are spread: each rank holds its part, of the right length also before reading, and the same number of ranks must read what they
   * wrote. Or each rank has all of them: then the first one's are stored, and given back to all. Scalars are the same on all ranks.
   */
  class SharedState : public RunState
  {
  public:
    /** @param on_first_rank where the state goes to or comes from; nullptr on other ranks. */
    SharedState(RunState *on_first_rank, bool reads, bool whole_on_each_rank);

    bool reads() const override { return reader; }
    void group(const std::string &name) override;

    /** @throws base::InputError on every rank, on reading, if the lengths do not fit. */
    void column(const std::string &name, base::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override;
    /** All ranks are told all parts, of which the first one's state takes them. @pre it does not read, and each rank has all */
    void column_in_parts(const std::string &name, std::size_t count, const Tell &tell) override;
    bool finds_by_name() const override { return reader && whole; }
    /** What the first one's state reads, all ranks take. @pre finds_by_name(), and take does not throw */
    void read_in_parts(const std::string &name, const Take &take) override;
    void scalar(const std::string &name, double &value) override;
    void scalar(const std::string &name, std::int64_t &value) override;

  private:
    template <typename Values>
    void visit_column(const std::string &name, Values &values);

    RunState *inner;
    bool      reader, whole;
  };
} // namespace apps
