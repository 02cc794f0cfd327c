#pragma once

#include "apps/scene/kinds/read_scene.h"
#include "apps/studies/replicate_statistics.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The curve of each run, the mean curve and its standard deviation, a panel for each test: stress over strain, or what section Output
   * names. @param runs that succeeded; not empty @param band nothing: there is none
   * @return why it could not be drawn, "" where it is
   */
  std::string draw_replicates(const std::filesystem::path           &file,
                              const CheckedScene                    &scene,
                              const std::vector<RunResult>          &runs,
                              const std::optional<ReplicatedSeries> &band);
} // namespace apps
