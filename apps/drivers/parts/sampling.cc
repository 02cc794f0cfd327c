#include "apps/drivers/parts/sampling.h"

namespace apps
{
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

  bool Sampling::snapshot_due() const
  {
    const auto due = [this](const std::int64_t sample) { return sample * snapshots / samples; };
    return finished() || due(taken) > due(before);
  }

  void Sampling::visit_state(RunState &state)
  {
    state.scalar("samples", taken);
    state.scalar("stopped", stopped);
  }
} // namespace apps
