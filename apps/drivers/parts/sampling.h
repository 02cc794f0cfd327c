#pragma once

#include "apps/results/run_state.h"
#include "apps/scene/output_section.h"

#include <cstdint>

namespace apps
{
  /** When the rows of a motion's series and its snapshots are due: evenly over its duration, besides those of its start. */
  class Sampling
  {
  public:
    /** @param rounding relative, of times to which the motion is led exactly; 0: it goes on until they are reached or passed */
    Sampling(double end_time, const OutputSection &output, double rounding = 0);

    double next_time() const; ///< of the next sample [s]
    /** Takes what is due at this time: several samples may fall into one step. @return whether any was */
    bool take(double time);
    /** The sample taken last is the last one: a stop condition holds. */
    void stop() { stopped = 1; }
    bool finished() const { return stopped != 0 || taken == samples; }
    /** With the samples taken last; always at the end. */
    bool snapshot_due() const;

    void visit_state(RunState &state);

  private:
    double       end, rounding;
    std::int64_t samples, snapshots;
    std::int64_t taken = 0, before = 0; ///< now, and before the last call of take()
    std::int64_t stopped = 0;
  };
} // namespace apps
