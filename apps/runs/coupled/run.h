#pragma once

#include "apps/figures/sampling.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/results/run_work.h"
#include "apps/runs/coupled/body.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/specimen_snapshots.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The work of a scene of kind "coupled".
   *
   * In the result folder, besides what every run has (run_files.h): packing.h5; coupled.pvd, which shows solid, particles and surfaces
   * together, with the snapshots and lists of each; and at the end curve.png, coupled.png (a cut through both), and of bonded particles state.h5 and crack.png.
   */
  class CoupledRun : public RunWork
  {
  public:
    CoupledRun(const RunRequest &request, const CoupledModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

    /** In its place, for a program that goes through a life-cycle state by state: no more windows from state to state than these. */
    void set_most_windows(const std::int64_t most) { most_windows = most; }
    /** Of a run that has begun. */
    CoupledBody       &moving() { return *body; }
    const CoupledBody &moving() const { return *body; }

  private:
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &folder) override;
    bool                                   whole_on_each_rank() const override { return true; }
    void                                   keep_files(const std::filesystem::path &folder, bool fresh) override;
    void                                   begin(const Record &record) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override { return body->columns(); }
    std::string                            size() const override;
    std::string                            stage() const override { return "motion"; }
    double                                 done() const override;
    std::string                            details() const override;
    bool                                   finished() const override { return sampling.finished(); }
    void                                   advance(const Record &record) override;
    void                                   leave_last_state() override { snapshot(); }
    RunFindings                            findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    void make_body();
    void record_row(const Record &record);
    void snapshot();
    void list_together() const;

    RunRequest                                request;
    const CoupledModel                       &model;
    dem::Packing                              packing;
    ParticleMedia                             media;     ///< that the particles are to the solid, where they are known
    std::shared_ptr<CoupledBody>              body;      ///< shared with the result, which holds its specimen
    MaterialCounts                            materials; ///< before anything moves
    StaticStart                               start;
    std::filesystem::path                     location;
    Sampling                                  sampling;
    SpecimenSnapshots                         snapshots;
    std::optional<postprocess::PvdCollection> solids;
    double                                    stepping_seconds = 0; ///< wall clock, since the run began or was resumed
    std::int64_t                              windows_before   = 0; ///< when it did
    std::int64_t                              most_windows     = std::numeric_limits<std::int64_t>::max();
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const CoupledModel &model, const RunRequest &request);
} // namespace apps
