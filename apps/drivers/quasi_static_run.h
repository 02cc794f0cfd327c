#pragma once

#include "apps/drivers/quasi_static_stage.h"
#include "apps/results/result_folder.h"

#include <chrono>
#include <memory>
#include <vector>

namespace apps
{
  /**
   * One run of a quasi-static scene: the tests one after the other, and everything that is written.
   *
   * In the result folder: packing.h5, scene.prm, series.csv (all tests), snapshots if asked for, checkpoint.h5 while running, and
   * at the end summary.json, curve.png and TEST_crack.png.
   */
  class QuasiStaticRun
  {
  public:
    QuasiStaticRun(const RunRequest &request, const QuasiStaticModel &model);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    using Clock = std::chrono::steady_clock;

    void   begin();
    void   resume();
    bool   complete_stage(); ///< @return false when interrupted
    void   save();
    void   finish();
    double wall_seconds() const;

    RunRequest                                 request;
    QuasiStaticModel                           model;
    dem::Packing                               packing;
    std::unique_ptr<ResultFolder>              folder;
    std::unique_ptr<postprocess::SeriesWriter> series;
    std::unique_ptr<QuasiStaticStage>          stage; ///< under way
    std::vector<QuasiStaticResult>             finished;
    double                                     seconds_before = 0; ///< of the same run, before it was resumed
    Clock::time_point                          start, last_saved;
  };
} // namespace apps
