#include "apps/runs/sequential/study_folder.h"

#include "apps/results/input_files.h"
#include "apps/results/life_cycle.h"
#include "apps/results/run_observer.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/numeric_text.h"

namespace apps
{
  namespace
  {
    ResultFolder opened(const RunRequest &request)
    {
      if (!request.resume && !request.restart)
        refuse_to_overwrite(request.output_folder);
      return {request.output_folder, request.resume ? ResultFolder::Start::resume : ResultFolder::Start::afresh};
    }
  } // namespace

  StudyFolder::StudyFolder(const RunRequest &requested)
    : request(requested)
    , folder(opened(requested))
  {
    const std::filesystem::path mark = folder.running() / checkpoint_name;
    if (request.resume)
      require_same_content(request.inputs, postprocess::numeric_text::read_whole(mark));
    postprocess::write_text(folder.running() / "scene.prm", request.scene_text);
    postprocess::write_text(mark, listed(request.inputs)); // states and continuations have checkpoints of their own
    notify(request, &RunObserver::saved, way_to_go_on(request));
  }

  RunResult StudyFolder::interrupted() const
  {
    RunResult result;
    result.end    = RunResult::End::interrupted;
    result.folder = request.output_folder;
    result.go_on  = way_to_go_on(request);
    return result;
  }
} // namespace apps
