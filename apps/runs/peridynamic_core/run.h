#pragma once

#include "apps/figures/sampled_motion.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/peridynamic_core/body.h"
#include "postprocess/vtk/pvd.h"

#include <memory>
#include <optional>

namespace apps
{
  /**
   * The work of a scene of kind "peridynamic_core".
   *
   * In the result folder, besides what every run has (run_files.h): peridynamic_core.pvd, which shows elements and core together, with the
   * snapshots and lists of each; at the end nodes.csv of the core, curve.png, displacement.png and damage.png.
   */
  class PeridynamicCoreRun : public SampledMotion
  {
  public:
    PeridynamicCoreRun(const RunRequest &request, const PeridynamicCoreModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

  private:
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &) override { prepare(); }
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

    RunRequest                                request;
    const PeridynamicCoreModel               &model;
    std::unique_ptr<PeridynamicCoreBody>      body;
    std::string                               horizontal, vertical; ///< of the curve
    std::filesystem::path                     location;
    std::optional<postprocess::PvdCollection> solids, nodes;
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const PeridynamicCoreModel &model, const RunRequest &request);
} // namespace apps
