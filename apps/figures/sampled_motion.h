#pragma once

#include "apps/figures/sampling.h"
#include "apps/results/run_work.h"

namespace apps
{
  /** The work of a motion to a given end, with rows and snapshots at times known beforehand. */
  class SampledMotion : public RunWork
  {
  public:
    std::string stage() const override { return "motion"; }
    double      done() const override;
    bool        finished() const override { return sampling.finished(); }
    void        advance(const Record &record) override;
    void        leave_last_state() override { snapshot(); }

  protected:
    SampledMotion(double end_time, const OutputSection &output);

    void stop() { sampling.stop(); } ///< the row recorded last is the last one
    void visit_sampling(RunState &state) { sampling.visit_state(state); }

  private:
    virtual double time() const                     = 0; ///< [s]
    virtual void   advance_to(double time)          = 0; ///< less far where the run is interrupted
    virtual void   record_row(const Record &record) = 0;
    virtual void   snapshot()                       = 0; ///< where there are any

    double   end;
    Sampling sampling;
  };
} // namespace apps
