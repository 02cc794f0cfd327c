#include "tests/places.h"

#include <iostream>

// Functions, so that constants of other sources may be made of them before main begins.
namespace places
{
  const std::string &sources()
  {
    static const std::string folder = BRECCIA_SOURCE_DIR;
    return folder;
  }
  std::string        scene(const std::string &name) { return sources() + "/apps/scenes/" + name; }
  const std::string &program()
  {
    static const std::string file = BRECCIA_PROGRAM;
    return file;
  }
  const std::string &mpirun()
  {
    static const std::string file = BRECCIA_MPIRUN;
    return file;
  }
  bool skipped_without_mpirun()
  {
    if (mpirun().empty())
      std::cout << "Skipped: there is no mpirun.\n";
    return mpirun().empty();
  }
} // namespace places
