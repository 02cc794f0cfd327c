#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/peridynamics/analysis.h"
#include "apps/runs/peridynamics/results.h"
#include "postprocess/vtk/pvd.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The work of a scene of kind "peridynamics".
   *
   * In the result folder, besides what every run has (run_files.h): nodes.pvd with its snapshots; at the end nodes.csv, displacement.png
   * and damage.png.
   */
  class PeridynamicsRun : public RunWork
  {
  public:
    PeridynamicsRun(const RunRequest &request, const PeridynamicsModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

  private:
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &) override { prepare(); }
    void                                   keep_files(const std::filesystem::path &folder, bool fresh) override;
    void                                   begin(const Record &record) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override { return analysis->columns(); }
    std::string                            size() const override { return body->size(); }
    std::string                            stage() const override;
    double                                 done() const override { return analysis->done(); }
    std::string                            details() const override { return analysis->details(); }
    bool                                   finished() const override { return analysis->finished(); }
    void                                   advance(const Record &record) override;
    RunFindings                            findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    void             snapshot();
    PeridynamicState state() const { return {*body, analysis->displacement()}; }

    RunRequest                                request;
    const PeridynamicsModel                  &model;
    std::unique_ptr<PeridynamicBody>          body;
    std::unique_ptr<PeridynamicAnalysis>      analysis;
    std::optional<postprocess::PvdCollection> nodes;
  };

  /**
   * "E 2.097e+11 Pa along the axes, ...": constants of the grid, for a terminal.
   * @param names of the materials; empty: there is one
   */
  std::string lattice_lines(const dem::peridynamics::Bonds &bonds, const std::vector<std::string> &names);

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const PeridynamicsModel &model, const RunRequest &request);
} // namespace apps
