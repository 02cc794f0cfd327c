#pragma once

#include "apps/figures/sampled_motion.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
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
   * together, with the snapshots and lists of each; and at the end curve.png, coupled.png (a cut through both), of bonded particles state.h5 and crack.png, and of a mix grading.png.
   */
  class CoupledRun : public SampledMotion
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
    std::string                            details() const override;
    double                                 time() const override { return body->time(); }
    void                                   advance_to(double time) override;
    void                                   record_row(const Record &record) override;
    void                                   snapshot() override;
    RunFindings                            findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    /** All but the curve. @param particles on the first rank; all ranks call this */
    void        write_pictures(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const;
    std::string title() const; ///< of pictures

    void make_body();
    void list_together() const;

    RunRequest                                request;
    const CoupledModel                       &model;
    dem::Packing                              packing;
    ParticleMedia                             media;     ///< that the particles are to the solid, where they are known
    std::shared_ptr<CoupledBody>              body;      ///< shared with the result, which holds its specimen
    MaterialCounts                            materials; ///< before anything moves
    StaticStart                               start;
    std::filesystem::path                     location;
    SpecimenSnapshots                         snapshots;
    std::optional<postprocess::PvdCollection> solids;
    double                                    stepping_seconds = 0; ///< wall clock, since the run began or was resumed
    std::int64_t                              windows_before   = 0; ///< when it did
    std::int64_t                              most_windows     = std::numeric_limits<std::int64_t>::max();
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const CoupledModel &model, const RunRequest &request);
} // namespace apps
