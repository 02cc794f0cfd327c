#include "apps/drivers/sequential/study_folder.h"

#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/results/input_files.h"
#include "apps/results/life_cycle.h"
#include "postprocess/atomic_file.h"
#include "postprocess/numeric_text.h"

#include <fmt/format.h>

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

  StudyFolder::StudyFolder(const RunRequest &asked)
    : request(asked)
    , folder(opened(asked))
  {
    const std::filesystem::path mark = folder.running() / checkpoint_name;
    if (request.resume)
      require_same_content(request.inputs, postprocess::numeric_text::read_whole(mark));
    postprocess::write_text(folder.running() / "scene.prm", request.scene_text);
    postprocess::write_text(mark, listed(request.inputs)); // states and continuations have checkpoints of their own
    set_last_words("interrupted in work that cannot be stopped half-way; what was finished is kept. " +
                   way_to_go_on(request));
  }

  int StudyFolder::interrupted() const
  {
    fmt::print(stderr, "breccia: interrupted, state saved. {}\n", way_to_go_on(request));
    return exit_interrupted;
  }
} // namespace apps
