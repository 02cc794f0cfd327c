// Work of fracture against what the bonds of a ligament hold, by wedge splitting of blocks of two sizes.
#include "tests/apps/scene_runs.h"

#include <catch2/catch.hpp>

#include <sstream>
#include <string>

using namespace apps_tests;

namespace
{
  /** n x n touching discs of 1 mm on a square lattice. */
  std::string square_block(const int n)
  {
    std::ostringstream text;
    for (int i = 0; i < n * n; ++i)
      text << 2e-3 * (i % n) + 1e-3 << ' ' << 2e-3 * (i / n) + 1e-3 << " 0 1e-3\n";
    return text.str();
  }

  /** Its halves hold, and a plane of bonds between them softens linearly; the upper ends beside it are driven apart. */
  std::string split_block(const int n)
  {
    const double       middle = 1e-3 * n, top = 2e-3 * n;
    std::ostringstream scene;
    const auto         law = [&scene](const char *limit, const char *ductility) {
      scene << "    set Law = CPM\n    subsection CPM\n      set Normal modulus = 25e9\n      set Shear ratio = 0.2\n"
            << "      set Limit elastic strain = " << limit
            << "\n      set Damage law = linear\n      set Relative ductility = " << ductility
            << "\n      set Cohesion = 1e9\n      set Friction coefficient = 0\n    end\n";
    };
    scene
      << "set Kind = structure\nsubsection Physics\n  set Dimension = 2\nend\nsubsection Specimen\n  set Source = "
         "file\n"
         "  set File = block.txt\n  set Thickness = 0.01\n  set Interaction ratio = 1.05\nend\nsubsection Materials\n";
    for (const char *half : {"left", "right"})
      {
        scene << "  subsection " << half << "\n";
        law("1e-2", "30");
        scene << "  end\n";
      }
    scene << "end\nsubsection Regions\n  subsection right half\n    set Material = right\n    set Shape = box\n    set "
             "Lower = "
          << middle << ", -1, -1\n    set Upper = 1, 1, 1\n  end\nend\nsubsection Interfaces\n  subsection ligament\n"
          << "    set Material = left\n    set Other material = right\n";
    law("1e-4", "30");
    scene << "  end\nend\nsubsection Groups\n";
    const auto group = [&scene](const char *name, const double x0, const double y0, const double x1, const double y1) {
      scene << "  subsection " << name << "\n    set Shape = box\n    set Lower = " << x0 << ", " << y0
            << ", -1\n    set Upper = " << x1 << ", " << y1 << ", 1\n  end\n";
    };
    group("left face", middle - 2e-3, top - 2e-3, middle, 1);
    group("right face", middle, top - 2e-3, middle + 2e-3, 1);
    group("foot", middle - 2e-3, -1, middle + 2e-3, 2e-3);
    scene << "end\nsubsection Supports\n  subsection left face\n    set Displacement x = -0.5*t\n  end\n"
             "  subsection right face\n    set Displacement x = 0.5*t\n  end\n  subsection foot\n    set Displacement "
             "y = 0\n"
             "  end\nend\nsubsection Path\n  set End = 2e-4\n  set Step = 2e-6\n  set Stop fraction = 0.01\nend\n"
             "subsection Wedge splitting\n  set Ligament depth = "
          << top << "\n  set Width = 0.01\nend\nsubsection Output\n  set Points per snapshot = 0\n"
          << "  set Curve vertical = reaction_right_face_x\nend\n";
    return scene.str();
  }
} // namespace

TEST_CASE("Work of fracture of a ligament is that of its bonds, whatever the size of the block that a wedge splits",
          "[apps][structure][slow]")
{
  // Of a bond E eps_0 eps_f/2 times its length, over as much of the ligament as it stands for.
  const double of_bonds = 0.5 * 25e9 * 1e-4 * 30e-4 * 2e-3;
  for (const int n : {6, 12})
    {
      const ScratchFolder folder;
      folder.file("block.txt", square_block(n));
      const Results found  = results_of(folder, folder.file("x.prm", split_block(n)), {}, {"control"});
      const auto    figure = [&found](const char *name) {
        return found.summary["figures"]["wedge_splitting"][name]["value"].get<double>();
      };
      INFO(n << " discs across: work " << figure("work_of_fracture") << ", left " << figure("load_left"));
      const double broken = (n - 1.0) / n; // the last bond is the hinge about which both halves turn
      CHECK(figure("work_of_fracture") == Approx(broken * of_bonds).epsilon(0.02));
      CHECK(figure("dissipated_over_ligament") == Approx(broken * of_bonds).epsilon(0.025));
      CHECK(figure("load_left") < 0.02);
    }
}
