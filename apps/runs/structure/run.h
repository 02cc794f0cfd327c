#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/structure/promotion.h"
#include "apps/specimens/link_classes.h"
#include "postprocess/vtk/pvd.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The work of a scene of kind "structure".
   *
   * In the result folder, besides what every run has (run_files.h): packing.h5; structure.pvd, which shows solid, particles and links
   * together, with the snapshots and lists of each; and at the end curve.png and crack.png.
   */
  class StructureRun : public RunWork
  {
  public:
    StructureRun(const RunRequest &request, const StructureModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

  private:
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &folder) override;
    void                                   keep_files(const std::filesystem::path &folder, bool fresh) override;
    void                                   begin(const Record &record) override;
    void                                   visit_state(RunState &state) override;
    bool                                   whole_on_each_rank() const override { return true; }
    std::vector<postprocess::SeriesColumn> series_columns() const override { return structure().columns(); }
    std::string                            size() const override { return structure().size(); }
    std::string                            stage() const override { return "equilibrium"; }
    double                                 done() const override;
    std::string                            details() const override;
    bool                                   finished() const override { return structure().finished(); }
    void                                   advance(const Record &record) override;
    void                                   leave_last_state() override { snapshot(); }
    RunFindings                            findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    Structure       &structure() { return promotion->structure(); }
    const Structure &structure() const { return promotion->structure(); }

    void        make_structure();
    void        note(const Record &record);
    bool        snapshot_due() const;
    void        snapshot();
    void        list_together() const;
    LinkClasses classes() const;
    std::string draw_crack(const std::filesystem::path &file) const;

    RunRequest                                request;
    const StructureModel                     &model;
    dem::Packing                              packing;
    ParticleMedia                             media; ///< that the particles are to the solid, where they are known
    std::optional<Promotion>                  promotion;
    std::filesystem::path                     location;
    std::optional<postprocess::PvdCollection> particles, links, solids;
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const StructureModel &model, const RunRequest &request);
} // namespace apps
