#pragma once

#include "apps/figures/sampling.h"
#include "apps/runs/peridynamics/analysis.h"
#include "dem/peridynamics/motion.h"

namespace apps
{
  /** A body that moves, with explicit steps. */
  class PeridynamicMotion : public PeridynamicAnalysis
  {
  public:
    PeridynamicMotion(const PeridynamicsModel &model, PeridynamicBody &body);

    std::vector<postprocess::SeriesColumn> columns() const override;
    void                                   begin(const RunWork::Record &record) override;
    void                                   advance(const RunWork::Record &record) override;
    bool                                   finished() const override { return sampling.finished(); }
    double                                 done() const override;
    std::string                            details() const override;
    void                                   visit_state(RunState &state) override;
    const dem::peridynamics::Field        &displacement() const override { return motion.displacement(); }
    bool                                   snapshot_due() const override { return sampled && sampling.snapshot_due(); }
    double                                 clock() const override { return motion.time(); }
    void                                   add_figures(nlohmann::json &figures) const override;
    std::vector<std::string>               warnings() const override { return {}; }

    double       step() const { return length; } ///< [s]
    std::int64_t steps() const;                  ///< to the end

  private:
    void record_row(const RunWork::Record &record);

    const PeridynamicsModel  &model;
    PeridynamicBody          &body;
    double                    length;
    dem::peridynamics::Motion motion;
    Sampling                  sampling;
    double                    worst = 0, largest = 0; ///< of the balance of energy, and energy [J]
    std::int64_t              sampled = 1;
  };
} // namespace apps
