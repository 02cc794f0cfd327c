#pragma once

#include "apps/results/run_files.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/results/run_work.h"
#include "base/stopwatch.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

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
    double          longest, cost = 0;
    base::Stopwatch since_saved;
  };

  /**
   * One run of any kind of scene: it begins or resumes, goes on state by state with checkpoints and interrupts, notifies its observers, and
   * ends with its result; where files are requested, with complete ones in place (run_files.h). Under MPI every rank calls it.
   */
  class LifeCycle
  {
  public:
    /** @param checkpoint_interval the longest [s]. */
    LifeCycle(const RunRequest &request, double checkpoint_interval, RunWork &work);

    /** Once. Throws as Scene::run(). */
    RunResult execute();

    // In its place, for a program that goes from state to state: start() once, go_on() until there is nothing more to do, finish() once.
    // Each throws as Scene::run().

    void start();
    /** To the next state. @return whether there is more to do; false: it is at its end, or was interrupted */
    bool go_on();
    /** Save, as after an interrupt: there is nothing more to do. */
    void      interrupt();
    RunResult finish();

  private:
    void begin();
    void resume();
    void advance();
    void complete();
    void save();
    void write_checkpoint();
    void visit_run(RunState &state, std::int64_t &rows);
    void record(const SeriesRow &row);
    void keep_files(bool fresh);
    /** On the first rank where every rank has all, otherwise on all of them. */
    void by_those_who_write(const std::function<void()> &action) const;

    bool   keeps_files() const { return !request.output_folder.empty(); }
    double wall_seconds() const { return seconds_before + watch.seconds(); }

    const RunRequest         &request;
    RunWork                  &work;
    std::filesystem::path     location; ///< where results grow; "": no files
    std::unique_ptr<RunFiles> files;    ///< first rank only, if any
    CheckpointClock           clock;
    RunResult                 result;
    double                    seconds_before = 0; ///< of the same run, before it was resumed
    base::Stopwatch           watch;
  };
} // namespace apps
