#pragma once

#include "tests/apps/scene_runs.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <string>
#include <vector>

/** Scenes of kind "coupled" in which balls meet a block. */
namespace apps_tests
{
  /** A spinning ball that meets an edge of a free block. */
  inline const std::string collision = R"(set Kind = coupled
subsection Continuum
  subsection Model
    set Dimension          = 3
    set Large displacement = true
  end
  subsection Mesh
    set Source = box
    subsection Box
      set Size        = 0.1, 0.1, 0.1
      set Divisions x = 3
      set Divisions y = 3
      set Divisions z = 3
    end
  end
  subsection Materials
    subsection solid
      set Law     = isotropic elastic
      set Density = 2400
      subsection isotropic elastic
        set Young modulus = 10e9
        set Poisson ratio = 0.2
      end
    end
  end
end
subsection Particles
  subsection Specimen
    set Source  = none
    set Density = 7800
  end
  subsection More particles
    subsection ball
      set Centre = 0.03, 0.062, 0.1205
      set Radius = 0.02
    end
  end
  subsection Material
    set Law = linear
    subsection linear
      set Effective modulus = 1e8
    end
  end
  subsection Initial velocity
    subsection ball
      set Velocity x = 2
      set Velocity y = -1
      set Velocity z = -5
      set Spin y     = 100
    end
  end
end
subsection Couplings
  subsection block
    set Effective modulus    = 1e8
    set Stiffness ratio      = 2.5
    set Friction coefficient = 0.4
  end
end
subsection Time
  set End time    = 4e-3
  set Damping     = 0
  set Step factor = 0.05
end
subsection Output
  set Samples   = 40
  set Snapshots = 4
end
)";

  /** Where the ball's step is three times that of the block. */
  inline const std::vector<std::string> solid_sub_cycled = {"Time/Largest ratio=10", "Time/Step factor=0.4",
                                                            "Couplings/block/Energy limit=1"};

  inline std::string reproducible_part(const std::filesystem::path &results)
  {
    return listing_of(results / "solid") + listing_of(results / "particles_particles") +
           content_of(results / "series.csv") + content_of(results / "coupled.pvd");
  }

  /** Instead of the collision: two balls at rest at this height [m], and the block, damped [1/s] and held at its back. */
  inline std::string two_balls_on_a_held_block(const std::string &height, const int damping)
  {
    std::string scene = replaced(collision, "    set Large displacement = true\n", "");
    scene             = replaced(
                  scene,
                  "  subsection Initial velocity\n    subsection ball\n      set Velocity x = 2\n      set Velocity y = -1\n"
                              "      set Velocity z = -5\n      set Spin y     = 100\n    end\n  end\n",
                  "");
    scene = replaced(scene, "set Centre = 0.03, 0.062, 0.1205", "set Centre = 0.03, 0.062, " + height);
    scene = replaced(scene, "    subsection ball\n",
                     "    subsection other\n      set Centre = 0.07, 0.02, " + height +
                       "\n      set Radius = 0.02\n    end\n    subsection ball\n");
    return replaced(scene, "  subsection Materials\n",
                    "  subsection Boundary conditions\n    subsection back\n      set Displacement x = 0\n"
                    "      set Displacement y = 0\n      set Displacement z = 0\n    end\n  end\n  subsection Motion\n"
                    "    set Damping = " +
                      std::to_string(damping) + "\n  end\n  subsection Materials\n");
  }

  inline std::string gravity(const std::string &upwards)
  {
    return "subsection Gravity\n  set Acceleration = 0, 0, " + upwards + "\nend\n";
  }

  /** Two balls that hang, glued, from the front face of a held block: weight pulls away from it. */
  inline std::string hanging()
  {
    return replaced(two_balls_on_a_held_block("0.12", 2000), "    set Friction coefficient = 0.4\n",
                    "    set Friction coefficient = 0.4\n    subsection Bond\n      set Within = 1e-6\n      set Law = "
                    "parallel-bond\n      subsection parallel-bond\n        set Effective modulus = 1e7\n        set "
                    "Tensile strength = 1e6\n        set Cohesion = 1e6\n      end\n    end\n") +
           gravity("9.81");
  }
} // namespace apps_tests
