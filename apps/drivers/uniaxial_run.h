#pragma once

#include "apps/drivers/uniaxial_model.h"
#include "apps/drivers/uniaxial_stage.h"
#include "apps/results/result_folder.h"
#include "apps/scene/scene.h"
#include "postprocess/series.h"

#include <chrono>
#include <memory>
#include <vector>

namespace apps
{
  /**
   * One run of a uniaxial scene: the tests one after the other, each on a fresh specimen, with everything that is
   * written.
   *
   * In the result folder: packing.h5, scene.prm, series.csv (all tests), TEST_particles.pvd and TEST_links.pvd with
   * their snapshots, checkpoint.h5 while running, and at the end TEST_state.h5, summary.json, curve.png and TEST_crack.png.
   */
  class UniaxialRun
  {
  public:
    UniaxialRun(const RunRequest &request, const UniaxialModel &model);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    using Clock = std::chrono::steady_clock;

    void begin();
    void resume();
    /** The stage under way to its end. @return false when interrupted. */
    bool   complete_stage();
    void   save();
    void   finish();
    double wall_seconds() const;

    RunRequest    request;
    UniaxialModel model;

    dem::Packing                               packing;
    std::unique_ptr<ResultFolder>              folder;
    std::unique_ptr<postprocess::SeriesWriter> series;
    std::unique_ptr<UniaxialStage>             stage;              ///< under way
    std::vector<UniaxialResult>                finished;           ///< of the stages before it
    double                                     seconds_before = 0; ///< of the same run, before it was resumed
    Clock::time_point                          start, last_saved;
  };
} // namespace apps
