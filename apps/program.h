#pragma once

namespace apps
{
  /**
   * The whole program: read the command line, run its command, and turn every error into one message.
   * @return exit status.
   */
  int run_program(int argc, char *argv[]);
} // namespace apps
