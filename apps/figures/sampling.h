#pragma once

#include "apps/models/output.h"
#include "apps/results/run_state.h"

#include <cstdint>

namespace apps
{
  /** When the rows of a motion's series and its snapshots are due: evenly over its duration, besides those of its start. */
  class Sampling
  {
  public:
    /** @param rounding relative, of times that the motion reaches exactly; 0: it goes on until they are reached or passed */
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

  /**
   * The same of a motion whose end is not known beforehand: its shortest duration has the requested number of rows, and whenever it has
   * lasted twice as long rows lie twice as far apart. So half as many or more show its later half, however long it lasts.
   */
  class OpenEndedSampling
  {
  public:
    explicit OpenEndedSampling(const OutputSection &output);

    /** What is sampled begins now. @param shortest that it lasts [s] */
    void   begin(double time, double shortest);
    double next_time() const; ///< of the next sample [s]
    bool   take(double time); ///< see Sampling
    bool   snapshot_due() const;

    void visit_state(RunState &state);

  private:
    std::int64_t samples, snapshots;
    double       start = 0, unit = 0;   ///< when it began, and from row to row at first [s]
    std::int64_t last = 0, apart = 1;   ///< time of the last row since then, and from there to the next, in that unit
    std::int64_t taken = 0, before = 0; ///< see Sampling
  };

  /** The same of a test that is counted in steps and may end at any of them: with its samples counted from 1, nothing is to be remembered. */
  class StepSampling
  {
  public:
    StepSampling() = default;
    /** @param steps that the test takes at most */
    StepSampling(std::int64_t steps, const OutputSection &output);

    std::int64_t steps() const { return steps_per_sample; } ///< of a sample, at least one
    /** With this sample; the last one of a test besides. */
    bool snapshot_due(std::int64_t sample) const;

  private:
    std::int64_t samples = 1, snapshots = 0, steps_per_sample = 1;
  };
} // namespace apps
