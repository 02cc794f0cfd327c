#pragma once

#include "apps/results/run_state.h"
#include "postprocess/files/series.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace dem
{
  class ObservedSpecimen;
}

namespace postprocess
{
  struct CsvTable;
}

namespace apps
{
  /** A new row of series.csv: words, numbers, and words again. */
  struct SeriesRow
  {
    std::vector<std::string> first;
    std::vector<double>      values;
    std::vector<std::string> last;
  };

  /** The findings of a complete run: for programs, and for a terminal. */
  struct RunFindings
  {
    nlohmann::json summary;
    std::string    words; ///< lines

    std::shared_ptr<const dem::ObservedSpecimen>
      specimen; ///< at the end, where a caller shall have it; nullptr: there are no particles
  };

  /**
   * What a run computes, as its life-cycle sees it (life_cycle.h): each kind of scene has one.
   *
   * Order: prepare(), or reopen() in its place; keep_files() where files are requested; begin(), or visit_state() in its place; then
   * advance() until finished(), with visit_state() in between for checkpoints; then findings() and, where files are requested,
   * write_results(). On several ranks each calls everything.
   */
  class RunWork
  {
  public:
    using Record = std::function<void(const SeriesRow &)>;

    virtual ~RunWork() = default;

    /**
     * Whether every rank has all of the state, not a part of it, or can be told of it. Then the first alone keeps files, a checkpoint says nothing of
     * ranks, and any number of them can go on from it.
     */
    virtual bool whole_on_each_rank() const { return false; }

    /** Make the model of a run that starts. Nothing is written yet: what can be refused is refused here. @throws base::InputError */
    virtual void prepare() = 0;

    /** In its place: make the model from what an interrupted run left in its folder. Its state follows by visit_state(). */
    virtual void reopen(const std::filesystem::path &folder) = 0;

    /** From now on write to this folder what grows on the way. @param fresh write what the run starts from, too: it is not resumed */
    virtual void keep_files(const std::filesystem::path &folder, bool fresh) = 0;

    /** From the start: rows that describe it, if any, are recorded. */
    virtual void begin(const Record &record) = 0;

    /** Everything to go on to the same bits. */
    virtual void visit_state(RunState &state) = 0;

    virtual std::vector<postprocess::SeriesColumn> series_columns() const = 0;

    virtual std::string size() const     = 0; ///< "175 particles, 1203 links"
    virtual std::string stage() const    = 0; ///< what is being done, e.g. "tension"
    virtual double      done() const     = 0; ///< part of the stage, in [0, 1]
    virtual std::string details() const  = 0; ///< where it is and how fast, for the progress line
    virtual bool        finished() const = 0;

    /**
     * Some further: to a state that a checkpoint can store, preferably within a second; rows that are due are recorded.
     * @throws StoppedShort; base::NumericalError when even the last state cannot be trusted.
     */
    virtual void advance(const Record &record) = 0;

    /** After StoppedShort: show the last state as well. */
    virtual void leave_last_state() {}

    /** The run is complete: what it found. @param series all rows, on the first rank @param wall_seconds that it took */
    virtual RunFindings findings(const postprocess::CsvTable &series, double wall_seconds) = 0;

    /**
     * After it: figures, states and tables of the end into the folder. The summary is written by the life-cycle. Of what every rank has, the first
     * alone writes (on_first_rank()).
     */
    virtual void write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) = 0;
  };

  /** The work cannot go on, but its last state stands and is worth keeping. */
  class StoppedShort : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace apps
