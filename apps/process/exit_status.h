#pragma once

namespace apps
{
  /** How the program leaves. */
  enum ExitStatus : int
  {
    exit_success     = 0,
    exit_failure     = 1,  ///< the computation broke down, or an internal error
    exit_bad_input   = 2,  ///< something the user gave, or results that cannot be written
    exit_interrupted = 130 ///< SIGINT, SIGTERM or SIGUSR1; a checkpoint was left if there was something to keep
  };
} // namespace apps
