#include "apps/results/short_run.h"

#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/results/result_folder.h"
#include "apps/results/run_observer.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"

namespace apps
{
  ShortRun::ShortRun(const RunRequest &requested, const std::string &what)
    : request(requested)
  {
    if (request.resume)
      throw base::InputError("--resume: " + what + " has no checkpoint. Run it again.");
    result.folder = request.output_folder;
  }

  bool ShortRun::interrupted() const
  {
    const StopsToo stops(request.stop);
    return interrupted_on_any_rank();
  }

  void ShortRun::says(const std::string &lines) { notify(request, &RunObserver::says, lines); }

  RunResult ShortRun::ended()
  {
    notify(request, &RunObserver::ends, result);
    return std::move(result);
  }

  RunResult ShortRun::interrupted_result()
  {
    result.end = RunResult::End::interrupted;
    return ended();
  }

  RunResult ShortRun::complete(nlohmann::json summary, const std::function<void(const std::filesystem::path &)> &write)
  {
    result.summary = std::move(summary);
    if (!request.output_folder.empty())
      on_first_rank([&] {
        ResultFolder folder(request.output_folder, ResultFolder::Start::afresh);
        postprocess::write_text(folder.running() / "scene.prm", request.scene_text);
        postprocess::write_json(folder.running() / "summary.json", result.summary);
        write(folder.running());
        folder.publish();
      });
    return ended();
  }
} // namespace apps
