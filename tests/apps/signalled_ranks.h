#pragma once

#include <string>

namespace apps_tests
{
  /**
   * Shell words before a program that leave its process number in the file "process.RANK", and those that interrupt
   * every process noted so. mpirun hands a signal on up to two seconds late, and a short run is over by then.
   */
  inline const std::string noting_its_process = "sh -c 'echo $$ > process.${OMPI_COMM_WORLD_RANK:-0}; exec \"$@\"' sh ";
  inline const std::string interrupt_noted    = "kill -INT $(cat process.*)";
} // namespace apps_tests
