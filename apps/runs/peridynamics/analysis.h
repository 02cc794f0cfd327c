#pragma once

#include "apps/results/run_work.h"
#include "apps/runs/peridynamics/model.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** A body with its bonds and what acts on it. */
  struct PeridynamicBody
  {
    dem::peridynamics::Bonds bonds;
    PeridynamicLoads         loads;

    /** @throws base::InputError also for loads out of balance on what nothing holds, where it shall come to rest */
    explicit PeridynamicBody(const PeridynamicsModel &model);

    double      largest_damage() const;
    std::string size() const; ///< "5000 nodes, 68000 bonds"
  };

  /** How a body comes to rest, or moves, as a run sees it. */
  class PeridynamicAnalysis
  {
  public:
    virtual ~PeridynamicAnalysis() = default;

    virtual std::vector<postprocess::SeriesColumn> columns() const = 0;
    virtual void                                   begin(const RunWork::Record &) {}
    virtual void                                   advance(const RunWork::Record &record) = 0;
    virtual bool                                   finished() const                       = 0;
    virtual double                                 done() const                           = 0;
    virtual std::string                            details() const                        = 0;
    virtual void                                   visit_state(RunState &state)           = 0;
    virtual const dem::peridynamics::Field        &displacement() const                   = 0;
    virtual bool                                   snapshot_due() const                   = 0; ///< after advance()
    virtual double clock() const = 0; ///< of a snapshot: time [s], load factor or number of a state

    /** What it found besides the series. */
    virtual void                     add_figures(nlohmann::json &figures) const = 0;
    virtual std::vector<std::string> warnings() const                           = 0;
  };

  /** @param body must outlive it */
  std::unique_ptr<PeridynamicAnalysis> make_analysis(const PeridynamicsModel &model, PeridynamicBody &body);

  /** When bonds first broke under a load factor that grew. */
  class FirstBreak
  {
  public:
    /** An equilibrium at a load factor, with the largest stretch over its limit. */
    void note(double factor, double of_limit);
    /**
     * The load factor: between the last state without and the first with a bond beyond its limit; where none came to it, in proportion from
     * the last state.
     */
    std::optional<double> factor() const;

    void visit_state(RunState &state);

  private:
    double before_factor = 0, before = 0, found = 0;
  };
} // namespace apps
