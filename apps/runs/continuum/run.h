#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/results/run_work.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/dissipated_places.h"
#include "apps/runs/continuum/softening_watch.h"
#include "apps/runs/continuum/summary.h"
#include "postprocess/vtk/pvd.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The work of a continuum analysis.
   *
   * In the result folder, besides what every run has (run_files.h; a row of the series per step or sample): solid.pvd with its
   * snapshots, and at the end curve.png and, where something can be damaged, damage.png, where bodies can touch, bodies.png,
   * of a linear solid in equilibrium stress.png. Under MPI every rank calls it; the first one writes.
   */
  template <int dim>
  class ContinuumRun : public RunWork
  {
  public:
    /** Gives a fresh solid its initial state, e.g. one mapped from particles. */
    using Prepare = std::function<void(fem::Solid<dim> &)>;

    /** Brings a prepared solid into equilibrium before the first step; its state then is the first row of the series. */
    using Settle = std::function<void(fem::Solid<dim> &, ContinuumAnalysis<dim> &)>;

    /** @throws base::InputError. start_mpi() must have been called. */
    ContinuumRun(const RunRequest     &request,
                 const ContinuumModel &model,
                 const Prepare        &prepare = {},
                 const Settle         &settle  = {});

    /**
     * Two more ends, which the summary reports: no equilibrium any more (otherwise execute() throws), and softening everywhere with
     * little force left (otherwise the run goes on).
     * @param least_force share of the largest one in the vertical column of the curve
     */
    void end_where_little_is_left(const double least_force)
    {
      failure_is_an_end = true;
      least_left        = least_force;
    }

    /** Throws as Scene::run(). */
    RunResult execute();

    /** How a run goes, as far as it was tried. */
    struct Rehearsal
    {
      double      first = 0, seconds = 0; ///< of the first state, of all [s]
      double      states = 0;             ///< recorded: steps, or samples of an explicit motion
      bool        ended  = false;         ///< for whatever reason
      std::string failure;                ///< that ended it; "": none
    };

    /**
     * Compute the first states and write nothing. The run can no longer be executed then.
     * @param states as many at most @param enough seconds after which no more than two are computed [s]
     * @throws StoppedShort if there is not even a first
     */
    Rehearsal rehearse(double states, double enough);

    const fem::Solid<dim>        &body() const { return *solid; }
    const ContinuumAnalysis<dim> &computation() const { return *analysis; }

    std::vector<postprocess::SeriesColumn> series_columns() const override;
    /** Those of them that are read from the solid. */
    std::vector<ProbeColumn> probe_columns() const { return probes->columns(); }

  private:
    void        prepare() override {}                             ///< the constructor has refused what is to be refused
    void        reopen(const std::filesystem::path &) override {} ///< so it does for one that is resumed
    void        keep_files(const std::filesystem::path &folder, bool fresh) override;
    void        begin(const Record &record) override;
    void        visit_state(RunState &state) override;
    std::string size() const override;
    std::string stage() const override;
    double      done() const override;
    std::string details() const override { return analysis->details(); }
    bool        finished() const override
    {
      return was_stopped || has_softened || !failure.empty() || !invalid.empty() || analysis->finished();
    }
    void        advance(const Record &record) override;
    void        leave_last_state() override { snapshot(); }
    RunFindings findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void        write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    SeriesRow   row();
    std::string draw_bodies() const; ///< @return what went wrong, "" if nothing
    std::string ended_by() const;    ///< see ContinuumReport
    void        snapshot();
    void        snapshot_if_due();
    void        choose_curve();

    RunRequest            request;
    const ContinuumModel &model;
    Settle                settle;

    std::unique_ptr<fem::Solid<dim>>          solid;
    std::unique_ptr<ContinuumAnalysis<dim>>   analysis;
    std::unique_ptr<ContinuumProbes<dim>>     probes;
    std::optional<postprocess::PvdCollection> snapshots;      ///< first rank only, as is the next
    base::Column                              snapshot_times; ///< kept where a resumed run takes none
    std::filesystem::path                     location;       ///< where results grow
    SofteningWatch<dim>                       watch;
    DissipatedPlaces<dim>                     dissipated;
    FractureZone                              zone; ///< updated where model.output requests it
    std::string                               horizontal, vertical;
    std::size_t                               vertical_index = 0;

    double       peak           = 0; ///< of the vertical column, in magnitude
    std::int64_t snapshot_count = 0; ///< taken so far
    std::int64_t snapshots_due  = 0; ///< on the way to the end
    bool         was_stopped = false, has_softened = false, failure_is_an_end = false;
    double       least_left = 0; ///< see end_where_little_is_left(); 0: not requested
    std::string  failure;        ///< that was the end; "": none
    std::string  invalid;        ///< why no state after the last would be worth anything; "": none

    std::optional<fem::SolidExtremes> extremes; ///< of the last state; not reported of solids in motion
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const ContinuumModel &model, const RunRequest &request);
} // namespace apps
