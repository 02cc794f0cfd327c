#pragma once

#include "apps/figures/sampling.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/results/run_work.h"
#include "apps/runs/cell/model.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/specimen_snapshots.h"

#include <memory>
#include <optional>

namespace apps
{
  struct CellReport;

  /**
   * The work of a periodic cell along its path.
   *
   * In the result folder, besides what every run has (run_files.h): packing.h5, cell_particles.pvd and cell_links.pvd with their
   * snapshots, and at the end curve.png, cell_crack.png and, of a mix, grading.png.
   */
  class CellRun : public RunWork
  {
  public:
    CellRun(const RunRequest &request, const CellModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

    static std::vector<postprocess::SeriesColumn> columns_of_series(); ///< of any model

  private:
    bool                                   whole_on_each_rank() const override { return true; }
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &folder) override;
    void                                   keep_files(const std::filesystem::path &folder, bool fresh) override;
    void                                   begin(const Record &record) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override { return columns_of_series(); }
    std::string                            size() const override;
    std::string                            stage() const override { return "cell"; }
    double                                 done() const override;
    std::string                            details() const override;
    bool                                   finished() const override { return test->finished(); }
    void                                   advance(const Record &record) override;
    RunFindings                            findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    void      make_test();
    SeriesRow row();
    /** @return what went wrong, "" if nothing */
    std::string draw_crack(const std::filesystem::path &file,
                           const dem::ParticleOutput   &particles,
                           const dem::LinkOutput       &links) const;

    CellReport report(double wall_seconds) const;

    RunRequest                     request;
    CellModel                      model;
    dem::Packing                   packing;
    std::shared_ptr<dem::Specimen> specimen;  ///< shared with the result
    MaterialCounts                 materials; ///< before anything moves
    std::optional<dem::CellTest>   test;
    std::int64_t                   steps = 0; ///< of the whole path
    StepSampling                   sampling;
    SpecimenSnapshots              snapshots;
    double                         worst_balance_error = 0;
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const CellModel &model, const RunRequest &request);
} // namespace apps
