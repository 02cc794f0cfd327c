#pragma once

#include "base/state.h"

namespace apps
{
  /** What a run must remember to go on to the same bits, on its way to a checkpoint or back. */
  class RunState : public base::StateVisitor
  {
  public:
    virtual bool reads() const = 0; ///< what is visited takes the values of the checkpoint

    /** The items that follow belong to this group; a name may be used once per group. */
    virtual void group(const std::string &name) = 0;
  };

  /** The state of a run in one process, for a postprocess::CheckpointWriter or CheckpointReader. */
  template <typename Checkpoint>
  class WholeState : public RunState
  {
  public:
    WholeState(Checkpoint &checkpoint_, const bool is_reader)
      : checkpoint(checkpoint_)
      , reader(is_reader)
    {
    }

    bool reads() const override { return reader; }
    void group(const std::string &name) override { checkpoint.group(name); }
    void column(const std::string &name, base::Column &values) override { checkpoint.column(name, values); }
    void column(const std::string &name, std::vector<std::int32_t> &values) override
    {
      checkpoint.column(name, values);
    }
    void column_in_parts(const std::string &name, const std::size_t count, const Tell &tell) override
    {
      checkpoint.column_in_parts(name, count, tell);
    }
    bool finds_by_name() const override { return reader; }
    void read_in_parts(const std::string &name, const Take &take) override { checkpoint.read_in_parts(name, take); }
    void scalar(const std::string &name, double &value) override { checkpoint.scalar(name, value); }
    void scalar(const std::string &name, std::int64_t &value) override { checkpoint.scalar(name, value); }

  private:
    Checkpoint &checkpoint;
    bool        reader;
  };
} // namespace apps
