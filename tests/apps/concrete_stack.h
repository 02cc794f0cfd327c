#pragma once

#include "tests/apps/scenes.h"

#include <string>

namespace apps_tests
{
  /** The stack of spheres, in packing.txt, as concrete with aggregates of 3 to 6 mm. */
  inline std::string concrete_stack()
  {
    return replaced(scene_with_file(), "  set Density           = 4800\n", R"(  set Density           = 4800
  set Box size          = 0.0102, 0.009, 0.012
  subsection Mix
    set Content            = 0.3
    set Grading            = passing
    set Curve              = 6e-3: 100, 3e-3: 10
    set Smallest aggregate = 3e-3
    subsection Interface
      set Ductility factor = 0.05
    end
  end
)");
  }
} // namespace apps_tests
