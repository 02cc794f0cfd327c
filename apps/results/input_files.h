#pragma once

#include "apps/results/run_request.h"

#include <string>
#include <vector>

namespace apps
{
  /** The files that a run reads, by entry and content, as text for its checkpoint: a line "bytes digest entry" for each. */
  std::string listed(const std::vector<InputFile> &inputs);

  /** @throws base::InputError naming the first file whose content is not that of the list; other names do not matter. */
  void require_same_content(const std::vector<InputFile> &inputs, const std::string &list);
} // namespace apps
