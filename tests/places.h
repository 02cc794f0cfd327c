#pragma once

#include <string>

/** Where tests find what they start and read. Known to one source only, so that all others compile alike in any folder. */
namespace places
{
  const std::string &sources();                      ///< folder of the sources, for scenes, meshes and reference files
  std::string        scene(const std::string &name); ///< one that is shipped, by its file's name
  const std::string &program();                      ///< the program `breccia`; "" where it is not built
  const std::string &mpirun();                       ///< "" where there is none
  /** Whether there is none; then a test of ranks says so and returns, and CTest counts it as skipped (tests/main.cc). */
  bool skipped_without_mpirun();
} // namespace places
