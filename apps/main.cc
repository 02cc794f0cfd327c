#include "apps/program.h"
#include "dem/core/floating_point_traps.h"

#include <csignal>

int main(int argc, char *argv[])
{
  std::signal(SIGXFSZ, SIG_IGN); // a file size limit then shows as a write error, which is reported like a full disk
  std::signal(SIGPIPE, SIG_IGN); // and so does a reader that went away
  dem::enable_floating_point_traps();
  return apps::run_program(argc, argv);
}
