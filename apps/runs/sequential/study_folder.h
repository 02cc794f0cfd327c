#pragma once

#include "apps/results/result_folder.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"

namespace apps
{
  /** The folder of a study of several runs, with the mark by which an interrupted one is known, and can go on. */
  class StudyFolder
  {
  public:
    /** Opens it and writes scene.prm. @throws postprocess::OutputError; base::InputError as ResultFolder, and for input files that changed */
    explicit StudyFolder(const RunRequest &request);

    const std::filesystem::path &running() const { return folder.running(); }

    /** Says how to go on. */
    RunResult interrupted() const;

    void publish() { folder.publish(); }

  private:
    RunRequest   request;
    ResultFolder folder;
  };
} // namespace apps
