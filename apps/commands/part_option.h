#pragma once

#include <CLI/App.hpp>

#include <string>

namespace apps
{
  /**
   * `--part 3/40`: one of several processes that share a folder of runs.
   *
   * @param part, parts which they are set to, from 1 on; must outlive the parsing. Another text is refused as options are that cannot be read
   */
  void add_part(CLI::App &command, int &part, int &parts, const std::string &meaning);
} // namespace apps
