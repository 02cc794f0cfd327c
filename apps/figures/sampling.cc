#include "apps/figures/sampling.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    /** Whether a snapshot is due after the sample `before` and up to the sample `now`: they are even over the samples. */
    bool due_between(const std::int64_t before,
                     const std::int64_t now,
                     const std::int64_t snapshots,
                     const std::int64_t samples)
    {
      return now * snapshots / samples > before * snapshots / samples;
    }
  } // namespace

  Sampling::Sampling(const double end_time, const OutputSection &output, const double relative_rounding)
    : end(end_time)
    , rounding(relative_rounding)
    , samples(output.samples)
    , snapshots(output.snapshots)
  {
  }

  double Sampling::next_time() const { return end * (static_cast<double>(taken + 1) / static_cast<double>(samples)); }

  bool Sampling::take(const double time)
  {
    before = taken;
    while (taken < samples && next_time() * (1 - rounding) <= time)
      ++taken;
    return taken > before;
  }

  bool Sampling::snapshot_due() const { return finished() || due_between(before, taken, snapshots, samples); }

  void Sampling::visit_state(RunState &state)
  {
    state.scalar("samples", taken);
    state.scalar("stopped", stopped);
  }

  OpenEndedSampling::OpenEndedSampling(const OutputSection &output)
    : samples(output.samples)
    , snapshots(output.snapshots)
  {
  }

  void OpenEndedSampling::begin(const double time, const double shortest)
  {
    start = time;
    unit  = shortest / static_cast<double>(samples);
    last = taken = before = 0;
    apart                 = 1;
  }

  double OpenEndedSampling::next_time() const { return start + unit * static_cast<double>(last + apart); }

  bool OpenEndedSampling::take(const double time)
  {
    before = taken;
    while (next_time() <= time)
      {
        last += apart;
        ++taken;
        if (last >= samples * apart)
          apart *= 2;
      }
    return taken > before;
  }

  bool OpenEndedSampling::snapshot_due() const { return due_between(before, taken, snapshots, samples); }

  void OpenEndedSampling::visit_state(RunState &state)
  {
    state.scalar("rows_start", start);
    state.scalar("rows_unit", unit);
    state.scalar("rows_last", last);
    state.scalar("rows_apart", apart);
    state.scalar("rows_taken", taken);
  }

  StepSampling::StepSampling(const std::int64_t steps, const OutputSection &output)
    : samples(output.samples)
    , snapshots(output.snapshots)
    , steps_per_sample(std::max<std::int64_t>(1, steps / output.samples))
  {
  }

  bool StepSampling::snapshot_due(const std::int64_t sample) const
  {
    return due_between(sample - 1, sample, snapshots, samples);
  }
} // namespace apps
