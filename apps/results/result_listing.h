#pragma once

#include <filesystem>
#include <string>

namespace apps
{
  /**
   * Lines for the terminal that say what a finished run left: its tables, summaries and figures, and the files for ParaView. Only what
   * is there: a figure that could not be drawn is not listed.
   */
  std::string result_listing(const std::filesystem::path &folder);
} // namespace apps
