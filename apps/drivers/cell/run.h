#pragma once

#include "apps/drivers/cell/scene.h"
#include "apps/drivers/parts/material_counts.h"
#include "apps/drivers/parts/sampling.h"
#include "apps/drivers/parts/specimen_snapshots.h"
#include "apps/results/run_work.h"

#include <optional>

namespace apps
{
  /**
   * The work of a periodic cell along its path.
   *
   * In the result folder, besides what every run has (life_cycle.h): packing.h5, cell_particles.pvd and cell_links.pvd with their
   * snapshots, and at the end summary.json, curve.png and cell_crack.png.
   */
  class CellRun : public RunWork
  {
  public:
    CellRun(const RunRequest &request, const CellModel &model);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    void                                   prepare() override;
    void                                   begin(const std::filesystem::path &folder, const Record &record) override;
    void                                   reopen(const std::filesystem::path &folder) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override;
    std::string                            size() const override;
    std::string                            stage() const override { return "cell"; }
    double                                 done() const override;
    std::string                            details() const override;
    bool                                   finished() const override { return test->finished(); }
    void                                   advance(const Record &record) override;
    std::string                            finish(const std::filesystem::path &folder, double wall_seconds) override;

    void      make_test();
    void      open(const std::filesystem::path &folder);
    SeriesRow row();
    /** @return what went wrong, "" if nothing */
    std::string draw_crack(const std::filesystem::path &file) const;

    RunRequest                   request;
    CellModel                    model;
    dem::Packing                 packing;
    std::optional<dem::Specimen> specimen;
    MaterialCounts               materials; ///< before anything moves
    std::optional<dem::CellTest> test;
    std::int64_t                 steps = 0; ///< of the whole path
    StepSampling                 sampling;
    SpecimenSnapshots            snapshots;
    double                       worst_balance_error = 0;
  };
} // namespace apps
