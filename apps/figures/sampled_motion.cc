#include "apps/figures/sampled_motion.h"

#include <algorithm>

namespace apps
{
  SampledMotion::SampledMotion(const double end_time, const OutputSection &output)
    : end(end_time)
    , sampling(end_time, output, 1e-12)
  {
  }

  double SampledMotion::done() const { return std::min(1.0, time() / end); }

  void SampledMotion::advance(const Record &record)
  {
    advance_to(sampling.next_time());
    if (!sampling.take(time())) // interrupted on the way
      return;
    record_row(record);
    if (sampling.snapshot_due())
      snapshot();
  }
} // namespace apps
