#pragma once

#include "apps/runs/peridynamics/analysis.h"

namespace apps
{
  /** A body under a load factor that grows to 1, with bonds that break between states at rest: what both ways of finding them share. */
  class PeridynamicRest : public PeridynamicAnalysis
  {
  public:
    PeridynamicRest(const PeridynamicsModel &model, PeridynamicBody &body);

    bool                            finished() const override { return ended != 0; }
    double                          done() const override;
    const dem::peridynamics::Field &displacement() const override { return u; }
    bool                            snapshot_due() const override { return ended != 0 || at_new_load; }
    double                          clock() const override { return static_cast<double>(states); }
    void                            add_figures(nlohmann::json &figures) const override;
    std::vector<std::string>        warnings() const override;
    void                            visit_state(RunState &state) override;

  protected:
    double factor() const; ///< that acts now
    /** A state at rest was found: bonds break, or the load grows. @return how many broke */
    std::int64_t go_on(const dem::peridynamics::BondForces &forces);
    /** A piece that nothing holds is loaded, or a mechanism: the body has broken through, and it ends. */
    void broke_through(bool mechanism = false);
    void ran_out_of_steps();
    void end() { ended = 1; }

    const PeridynamicsModel &model;
    PeridynamicBody         &body;
    dem::peridynamics::Field u;

  private:
    FirstBreak   first;
    std::int64_t increment = 1, states = 0, ended = 0, restless = 0;
    std::int64_t through     = 0; ///< 1: a piece that nothing holds was loaded; 2: a mechanism
    bool         at_new_load = false;
  };

  /** By sparse factors. */
  class PeridynamicStatics : public PeridynamicRest
  {
  public:
    PeridynamicStatics(const PeridynamicsModel &model, PeridynamicBody &body);

    std::vector<postprocess::SeriesColumn> columns() const override;
    void                                   advance(const RunWork::Record &record) override;
    std::string                            details() const override;
    void                                   visit_state(RunState &state) override;

  private:
    dem::peridynamics::Equilibrium equilibrium;
    double                         residual = 0;
    std::int64_t                   broken   = 0;
  };

  /** By adaptive dynamic relaxation. */
  class PeridynamicRelaxation : public PeridynamicRest
  {
  public:
    PeridynamicRelaxation(const PeridynamicsModel &model, PeridynamicBody &body);

    std::vector<postprocess::SeriesColumn> columns() const override;
    void                                   advance(const RunWork::Record &record) override;
    std::string                            details() const override;
    void                                   visit_state(RunState &state) override;

  private:
    void load();
    void step(const RunWork::Record &record);
    bool loose() const;

    dem::peridynamics::Relaxation relaxation;
    std::int64_t                  since_load = 0, broken = 0, begun = 0;
  };
} // namespace apps
