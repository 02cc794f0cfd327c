#pragma once

#include "apps/results/run_observer.h"
#include "apps/results/run_request.h"
#include "postprocess/files/html_page.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  struct RunResult;

  /**
   * A page of a run that is complete (postprocess::HtmlPage): the request, warnings, figures, energies, cost, the series as curves, the
   * pictures of its folder; in it the scene and the files that it names, from which "breccia run PAGE" gives the same bits again.
   * @param request its scene and inputs @param result with the folder of its pictures
   * @throws base::InputError for pictures and inputs that cannot be read; postprocess::OutputError
   */
  std::string page_of(const RunRequest &request, const RunResult &result);

  /** What the text of a scene calls one of its files. */
  std::string name_in(const std::string &scene_text, const InputFile &input);

  /** Put a scene into a page, and the files that it names, so that it can be run from there. */
  void add_scene(postprocess::HtmlPage &page, const std::string &scene_text, const std::vector<InputFile> &inputs);

  /** Writes the page as report.html into the folder of a run, once that is complete. */
  class RunReport : public RunObserver
  {
  public:
    /** @param request must outlive it */
    explicit RunReport(const RunRequest &requested)
      : request(requested)
    {
    }
    void ends(const RunResult &result) override;

  private:
    const RunRequest &request;
  };

  /** Its name in a folder of results. */
  extern const char *const report_name;
} // namespace apps
