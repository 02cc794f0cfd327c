#pragma once

#include <CLI/App.hpp>

#include <functional>
#include <vector>

namespace apps
{
  /** The chosen command; @return exit status. */
  using Action = std::function<int()>;

  /**
   * Adds one sub-command, with its options, to the program; when the user typed it, `chosen` becomes what it does.
   *
   * Actions run after the whole command line was accepted.
   */
  using AddCommand = void (*)(CLI::App &program, Action &chosen);

  /** Every command there is; a new one is one declaration and one line in all.cc. */
  const std::vector<AddCommand> &all_commands();
} // namespace apps
