#pragma once

#include "apps/bench/structure.h"

namespace apps
{
  /**
   * The first equilibria of the beam with a core, for smaller and smaller particles, by a factor and by iteration (doc/theory/quasi-static-path.md,
   * 4): processor time of both, and by how much their forces differ.
   *
   * Written after every case to structure_solvers.csv and structure_solvers.md, at the end to structure_solvers.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_structure_solvers(const StructureBench &bench);
} // namespace apps
