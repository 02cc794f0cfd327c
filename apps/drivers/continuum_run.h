#pragma once

#include "apps/drivers/continuum_analysis.h"
#include "apps/results/result_folder.h"
#include "apps/scene/scene.h"
#include "postprocess/checkpoint.h"
#include "postprocess/pvd.h"
#include "postprocess/series.h"

#include <chrono>
#include <memory>
#include <optional>

namespace apps
{
  /**
   * One run of a continuum analysis, with everything that is written.
   *
   * In the result folder: scene.prm, series.csv (a row per step or sample), solid.pvd with its snapshots, checkpoint.h5 while
   * running, and at the end summary.json, curve.png and, where something can
   * be damaged, damage.png. Under MPI every rank calls it; the first one writes.
   */
  template <int dim>
  class ContinuumRun
  {
  public:
    /** Gives a fresh solid its initial state, e.g. one mapped from particles. */
    using Prepare = std::function<void(fem::Solid<dim> &)>;

    /** Brings a prepared solid into equilibrium before the first step; its state then is the first row of the series. */
    using Settle = std::function<void(fem::Solid<dim> &, ContinuumAnalysis<dim> &)>;

    /** @throws dem::InputError. start_mpi() must have been called. */
    ContinuumRun(const RunRequest     &request,
                 const ContinuumModel &model,
                 const Prepare        &prepare = {},
                 const Settle         &settle  = {});

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

    const fem::Solid<dim>        &body() const { return *solid; }
    const ContinuumAnalysis<dim> &computation() const { return *analysis; }

  private:
    using Clock = std::chrono::steady_clock;

    void              begin();
    void              resume();
    bool              record();
    void              complete();
    void              snapshot();
    void              save();
    void              finish();
    void              choose_curve();
    double            wall_seconds() const;
    void              visit_own_state(dem::StateVisitor &visitor);
    [[noreturn]] void fail(const std::string &reason);

    std::vector<postprocess::SeriesColumn> columns() const;

    RunRequest            request;
    const ContinuumModel &model;
    Settle                settle;

    std::unique_ptr<fem::Solid<dim>>           solid;
    std::unique_ptr<ContinuumAnalysis<dim>>    analysis;
    std::unique_ptr<ContinuumGauges<dim>>      gauges;
    std::unique_ptr<ResultFolder>              folder; ///< first rank only, as are the next two
    std::unique_ptr<postprocess::SeriesWriter> series;
    std::optional<postprocess::PvdCollection>  snapshots;
    std::filesystem::path                      location; ///< where results grow
    std::string                                horizontal, vertical;
    std::size_t                                vertical_index = 0;

    double            peak            = 0; ///< of the vertical column, in magnitude
    std::int64_t      snapshot_count  = 0; ///< taken so far
    std::int64_t      snapshots_due   = 0; ///< on the way to the end
    std::int64_t      row_count       = 0;
    bool              was_interrupted = false, was_stopped = false;
    double            seconds_before = 0; ///< of the same run, before it was resumed
    Clock::time_point start, last_saved;
  };
} // namespace apps
