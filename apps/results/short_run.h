#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"

#include <functional>
#include <string>

namespace apps
{
  /** A run without checkpoint: parts of seconds each, of which nothing is kept before all are done. Of several ranks the first writes. */
  class ShortRun
  {
  public:
    /** @param what it is, "a homogenisation" @throws base::InputError where it is to be resumed */
    ShortRun(const RunRequest &request, const std::string &what);

    bool      interrupted() const;            ///< leave then, with interrupted_result()
    void      says(const std::string &lines); ///< to the observers: a part is done
    RunResult interrupted_result();

    /**
     * All is done: scene.prm, summary.json and what else is written to the folder, where files are requested.
     * @param write the rest to this folder
     */
    RunResult complete(nlohmann::json summary, const std::function<void(const std::filesystem::path &)> &write);

  private:
    RunResult ended();

    const RunRequest &request;
    RunResult         result;
  };
} // namespace apps
