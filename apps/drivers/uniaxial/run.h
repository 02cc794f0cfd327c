#pragma once

#include "apps/drivers/uniaxial/model.h"
#include "apps/drivers/uniaxial/stage.h"
#include "apps/results/run_work.h"
#include "apps/scene/scene.h"

#include <memory>
#include <vector>

namespace apps
{
  /**
   * The work of a uniaxial scene: the tests one after the other, each on a fresh specimen.
   *
   * In the result folder, besides what every run has (life_cycle.h): packing.h5, TEST_particles.pvd and TEST_links.pvd with
   * their snapshots, and at the end TEST_state.h5, summary.json, curve.png and TEST_crack.png.
   */
  class UniaxialRun : public RunWork
  {
  public:
    UniaxialRun(const RunRequest &request, const UniaxialModel &model);

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

    RunRequest                     request;
    UniaxialModel                  model;
    dem::Packing                   packing;
    std::filesystem::path          location;
    std::unique_ptr<UniaxialStage> test;     ///< under way
    std::vector<UniaxialResult>    complete; ///< of the tests before it
  };
} // namespace apps
