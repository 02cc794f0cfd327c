#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_work.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  struct RunResult;

  /** A run that begins: its model is made, nothing is computed yet. */
  struct RunOutline
  {
    std::string                            scene_file; ///< as typed; "": it comes from a program
    std::string                            size;       ///< "175 particles, 1203 links"
    std::vector<postprocess::SeriesColumn> columns;    ///< of its rows
    std::filesystem::path                  location;   ///< where its files grow; "": it writes none
    bool                                   resumed = false;
  };

  /**
   * Follows a run: a terminal, a study, a program that draws. Calls come in this order, from the thread that runs, on every
   * rank. What an observer throws ends the run.
   */
  class RunObserver
  {
  public:
    virtual ~RunObserver() = default;

    /** The model is about to be made. */
    virtual void prepares() {}
    virtual void begins(const RunOutline &) {}
    /** A row of the series, of this process: those from before a resumption are in the result. */
    virtual void row(const SeriesRow &) {}
    /** A part of the work begins, "tension"; the last one is "results". */
    virtual void stage(const std::string &) {}
    /** @param done part of the stage, in [0, 1] @param details where it is and how fast */
    virtual void progress(double /*done*/, const std::string & /*details*/) {}
    /** Lines about a part of the work that is done. */
    virtual void says(const std::string &) {}
    /** A sentence about the model that a user should doubt; those about results are in the summary. */
    virtual void warns(const std::string &) {}
    /** A checkpoint stands. @param go_on the command that goes on from it */
    virtual void saved(const std::string & /*go_on*/) {}
    virtual void ends(const RunResult &) {}

    /** Whether it wants to see what a long part of the work says of itself (Progress); without such an observer nothing is printed. */
    virtual bool shows_progress() const { return false; }
  };

  /** Call one of its functions for every observer of a request: notify(request, &RunObserver::says, lines). */
  template <typename... Declared, typename... Given>
  void notify(const RunRequest &request, void (RunObserver::*what)(Declared...), const Given &...given)
  {
    for (RunObserver *observer : request.observers)
      (observer->*what)(given...);
  }

  inline bool shows_progress(const RunRequest &request)
  {
    return std::any_of(request.observers.begin(), request.observers.end(),
                       [](const RunObserver *observer) { return observer->shows_progress(); });
  }
} // namespace apps
