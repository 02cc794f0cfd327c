#pragma once

#include "apps/results/run_request.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** What every summary begins with: the scene, what was asked, and by which version of the program it was answered. */
  nlohmann::json summary_head(const RunRequest &request, const std::string &kind);

  /** A figure of a summary. @param unit "" as "-" */
  nlohmann::json quantity(double value, const std::string &unit);
} // namespace apps
