#pragma once

#include "apps/results/run_observer.h"

#include <filesystem>
#include <string>

namespace apps
{
  struct RunResult;

  /**
   * A page of a run that is complete (postprocess::HtmlPage): what was asked, warnings, figures, energies, cost, the series as curves, the
   * pictures of its folder; in it the scene and the files that it names, from which "breccia run PAGE" gives the same bits again.
   * @param request its scene and inputs @param result with the folder of its pictures
   * @throws base::InputError for pictures and inputs that cannot be read; postprocess::OutputError
   */
  std::string page_of(const RunRequest &request, const RunResult &result);

  /** Writes the page as report.html into the folder of a run, once that is complete. */
  class RunReport : public RunObserver
  {
  public:
    /** @param request must outlive it */
    explicit RunReport(const RunRequest &asked)
      : request(asked)
    {
    }
    void ends(const RunResult &result) override;

  private:
    const RunRequest &request;
  };

  /** Its name in a folder of results. */
  extern const char *const report_name;
} // namespace apps
