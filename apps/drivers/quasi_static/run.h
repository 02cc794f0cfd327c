#pragma once

#include "apps/drivers/quasi_static/stage.h"
#include "apps/results/run_work.h"

#include <memory>
#include <vector>

namespace apps
{
  /**
   * The work of a quasi-static scene: the tests one after the other.
   *
   * In the result folder, besides what every run has (life_cycle.h): packing.h5, snapshots if asked for, and at the end
   * summary.json, curve.png and TEST_crack.png.
   */
  class QuasiStaticRun : public RunWork
  {
  public:
    QuasiStaticRun(const RunRequest &request, const QuasiStaticModel &model);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    void                                   prepare() override;
    void                                   begin(const std::filesystem::path &folder, const Record &record) override;
    void                                   reopen(const std::filesystem::path &folder) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override;
    std::string                            size() const override;
    std::string                            stage() const override;
    double                                 done() const override;
    std::string                            details() const override;
    bool                                   finished() const override;
    void                                   advance(const Record &record) override;
    std::string                            finish(const std::filesystem::path &folder, double wall_seconds) override;

    void make_stage();
    void complete_stage();

    RunRequest                        request;
    QuasiStaticModel                  model;
    dem::Packing                      packing;
    std::filesystem::path             location;
    std::unique_ptr<QuasiStaticStage> test;     ///< under way
    std::vector<QuasiStaticResult>    complete; ///< of the tests before it
  };
} // namespace apps
