#include "tests/apps/scenes.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace apps_tests
{
  std::string stack_packing()
  {
    const double       radius = 1e-3, spacing = 2.04e-3;
    std::ostringstream text;
    text.precision(17);
    text << "# x y z radius [m]\n";
    for (int k = 0; k < 7; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i)
          text << spacing * (i + 0.5 * ((j + k) % 2)) << ' ' << spacing * std::sqrt(3.0) / 2 * (j + (k % 2) / 3.0)
               << ' ' << spacing * std::sqrt(2.0 / 3.0) * k << ' ' << radius << '\n';
    return text.str();
  }

  std::string pair_packing() { return "0 0 0 1e-3\n0 0 2e-3 1e-3\n"; }

  std::string material_of_concrete()
  {
    return R"(subsection Material
  set Law = CPM
  subsection CPM
    set Normal modulus       = 25e9
    set Shear ratio          = 0.2
    set Limit elastic strain = 1e-4
    set Relative ductility   = 30
    set Cohesion             = 3e6
    set Friction coefficient = 0.8
  end
end
)";
  }

  std::string mix_of_two_sizes()
  {
    return R"(  subsection Mix
    set Content            = 0.3
    set Grading            = passing
    set Curve              = 6e-3: 100, 4e-3: 0
    set Smallest aggregate = 4e-3
    set Sizes              = drawn
  end
)";
  }

  std::string scene_with_file()
  {
    return R"(set Kind = uniaxial
subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Density           = 4800
  set Interaction ratio = 1.5
end
)" + material_of_concrete() +
           R"(subsection Loading
  set Grip thickness = 0.5e-3
  subsection Tension
    set Strain rate = 4
  end
  subsection Compression
    set Strain rate = 20
  end
end
subsection Output
  set Samples   = 50
  set Snapshots = 5
end
)";
  }

  std::string replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto place = text.find(from);
    if (place == std::string::npos)
      throw std::logic_error("nothing to replace: " + from);
    return text.replace(place, from.size(), to);
  }

  std::string loose_balls(const std::string &effective_modulus)
  {
    return R"(set Kind = particles
subsection Specimen
  set Source  = none
  set Density = 2500
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus = )" +
           effective_modulus + R"(
  end
end
)";
  }
} // namespace apps_tests
