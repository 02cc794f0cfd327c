#pragma once

#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <cstdlib>
#include <string>
#include <vector>

namespace apps_tests
{
  /** The program on so many ranks and threads, as a shell says it; 0 ranks: without mpirun. */
  inline std::string program_on(const int ranks, const int threads, const std::string &prefix = "")
  {
    const std::string mpi = ranks == 0 ? "" : places::mpirun() + " --oversubscribe -np " + std::to_string(ranks) + " ";
    return "OMP_NUM_THREADS=" + std::to_string(threads) + " " + mpi + prefix + places::program();
  }

  /** What the command says lands in the file "said". */
  inline int shell_in(const ScratchFolder &folder, const std::string &command)
  {
    return std::system(("cd " + folder.path().string() +
                        " && export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 && { " + command +
                        "; } > said 2>&1")
                         .c_str());
  }

  inline std::string run_of(const std::string &scene, const std::vector<std::string> &changes = {})
  {
    std::string words = " run " + places::sources() + "/apps/scenes/" + scene;
    for (const std::string &change : changes)
      words += " -s '" + change + "'";
    return words;
  }

  /**
   * Shell words before a program that leave its process number in the file "process.RANK", and those that interrupt
   * every process noted so. mpirun hands a signal on up to two seconds late, and a short run is over by then.
   */
  inline const std::string noting_its_process = "sh -c 'echo $$ > process.${OMPI_COMM_WORLD_RANK:-0}; exec \"$@\"' sh ";
  inline const std::string interrupt_noted    = "kill -INT $(cat process.*)";
} // namespace apps_tests
