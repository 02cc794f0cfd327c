#pragma once

#include "dem/state.h"

namespace apps
{
  /**
   * State that is spread over the ranks, as one state of the first rank: what a checkpoint stores and gives back.
   *
   * Columns are spread: each rank holds its part, of the right length also before reading. Scalars are the same on all
   * ranks. The same number of ranks must read what they wrote.
   */
  class SharedState : public dem::StateVisitor
  {
  public:
    enum class Direction
    {
      write,
      read
    };

    /** @param on_first_rank where the state goes to or comes from; nullptr on other ranks. */
    SharedState(dem::StateVisitor *on_first_rank, Direction direction);

    /** @throws dem::InputError on every rank, on reading, if the lengths do not fit. */
    void column(const std::string &name, dem::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override;
    void scalar(const std::string &name, double &value) override;
    void scalar(const std::string &name, std::int64_t &value) override;

  private:
    dem::StateVisitor *inner;
    Direction          direction;
  };
} // namespace apps
