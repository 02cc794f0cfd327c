#pragma once

#include "apps/process/progress.h"
#include "apps/results/run_observer.h"

#include <optional>

namespace apps
{
  /** Shows how far a run is, and nothing else: one that is part of a larger run. */
  class ProgressLine : public RunObserver
  {
  public:
    void stage(const std::string &name) override;
    void progress(double done, const std::string &details) override;
    void ends(const RunResult &) override { line.reset(); }
    bool shows_progress() const override { return true; }

  private:
    std::optional<Progress> line;
  };

  /** Shows a run on the terminal: how it begins, how far it is, what it found, how an interrupted one goes on. */
  class Terminal : public ProgressLine
  {
  public:
    void prepares() override;
    void begins(const RunOutline &outline) override;
    void says(const std::string &text) override;
    void warns(const std::string &sentence) override;
    void saved(const std::string &go_on) override;
    void ends(const RunResult &result) override;
  };
} // namespace apps
