#pragma once

#include "apps/results/run_request.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** The beginning of every summary: the scene, the request, and the version of the program that answered it. */
  nlohmann::json summary_head(const RunRequest &request, const std::string &kind);

  /** A figure of a summary. @param unit "" as "-" */
  nlohmann::json quantity(double value, const std::string &unit);

  /** What a summary warns of, as lines for the terminal. */
  std::string warning_lines(const std::vector<std::string> &warnings);
} // namespace apps
