#pragma once

#include "apps/process/progress.h"
#include "apps/process/stopwatch.h"
#include "apps/results/input_files.h"
#include "apps/results/result_folder.h"
#include "apps/results/run_work.h"
#include "apps/scene/scene.h"
#include "postprocess/checkpoint.h"

#include <memory>
#include <optional>

namespace apps
{
  /** How a run that was interrupted goes on: "Go on with: mpirun -n 2 breccia run FOLDER/running/scene.prm --resume". */
  std::string way_to_go_on(const RunRequest &request);

  /** When a checkpoint is due: a minute after the last one, later where saving takes more than a fiftieth of the time. */
  class CheckpointClock
  {
  public:
    /** @param longest_interval between checkpoints in any case [s] */
    explicit CheckpointClock(double longest_interval);

    bool is_due() const;

    /** Do it, and note what it took. */
    void save(const std::function<void()> &write);

    double seconds_since_saved() const;

  private:
    double    longest, cost = 0;
    Stopwatch since_saved;
  };

  /**
   * One run of any kind of scene: it begins or resumes, goes on state by state with progress, checkpoints and interrupts, and
   * finishes with complete results in place.
   *
   * In the folder "running" below the results: scene.prm, series.csv, checkpoint.h5, and what the work writes. Under MPI every
   * rank calls it; the first one writes.
   */
  class LifeCycle
  {
  public:
    /** @param checkpoint_interval the longest [s]. */
    LifeCycle(const RunRequest &request, double checkpoint_interval, RunWork &work);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    void   begin();
    void   resume();
    void   announce() const;
    bool   complete(); ///< @return false when interrupted
    void   advance();
    void   finish();
    void   save();
    void   write_checkpoint();
    void   visit_run(RunState &state, std::int64_t &rows);
    void   record(const SeriesRow &row);
    double wall_seconds() const;

    const RunRequest                          &request;
    RunWork                                   &work;
    std::filesystem::path                      location; ///< where results grow
    std::unique_ptr<ResultFolder>              folder;   ///< first rank only, as is the next
    std::unique_ptr<postprocess::SeriesWriter> series;
    CheckpointClock                            clock;
    double                                     seconds_before = 0; ///< of the same run, before it was resumed
    Stopwatch                                  watch;
  };
} // namespace apps
