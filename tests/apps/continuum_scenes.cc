#include "tests/apps/continuum_scenes.h"

namespace apps_tests
{
  std::string concrete_beam_scene()
  {
    return R"(set Kind = continuum
subsection Model
  set Dimension = 2
  set Plane     = stress
  set Thickness = 0.1
end
subsection Mesh
  set Source = notched beam
  subsection Notched beam
    set Length      = 0.45
    set Height      = 0.1
    set Span        = 0.4
    set Notch depth = 0.03
    set Notch width = 0.01
    set Band        = 0.03
    set Fine size   = 0.01
    set Coarse size = 0.04
  end
end
subsection Materials
  subsection solid
    set Law = damage-plastic concrete
    subsection damage-plastic concrete
      set Young modulus        = 30e9
      set Poisson ratio        = 0.2
      set Compressive strength = 30e6
      set Tensile strength     = 3e6
      set Fracture energy      = 100
    end
  end
end
subsection Supports
  subsection load
    set From           = 0.22, 0.1, 0
    set To             = 0.23, 0.1, 0
    set Displacement x = 0
    set Displacement y = -t
  end
  subsection left support
    set From           = 0.025, 0, 0
    set Displacement y = 0
  end
  subsection right support
    set From           = 0.425, 0, 0
    set Displacement y = 0
  end
end
subsection Points
  subsection left lip
    set Position = 0.22, 0, 0
  end
  subsection right lip
    set Position = 0.23, 0, 0
  end
end
subsection Control
  set Follow       = indirect
  set Opening from = left lip
  set Opening to   = right lip
  set End          = 1e-4
  set First step   = 2e-6
end
subsection Output
  set Snapshots = 4
end
)";
  }

  std::string impact_scene()
  {
    return R"(set Kind = continuum
subsection Model
  set Dimension = 3
  set Analysis  = explicit
end
subsection Mesh
  set Source = box
  subsection Box
    set Size        = 0.5, 0.02, 0.02
    set Divisions x = 50
    set Divisions y = 2
    set Divisions z = 2
  end
end
subsection Materials
  subsection solid
    set Law     = isotropic elastic
    set Density = 7850
    subsection isotropic elastic
      set Young modulus = 200e9
      set Poisson ratio = 0
    end
  end
end
subsection Boundary conditions
  subsection left
    set Displacement x = 0
  end
end
subsection Points
  subsection free end
    set Position = 0.5, 0.01, 0.01
  end
end
subsection Motion
  set End time           = 1.9e-4
  set Initial velocity x = -10
end
subsection Output
  set Samples   = 190
  set Snapshots = 4
end
)";
  }

  std::string pulled_box(const std::string &box, const std::string &solid, const std::string &displacement)
  {
    return R"(set Kind = continuum
subsection Model
  set Dimension = 3
end
subsection Mesh
  set Source = box
  subsection Box
)" + box + R"(  end
end
subsection Materials
  subsection solid
)" + solid +
           R"(  end
end
subsection Boundary conditions
  subsection left
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = 0
  end
  subsection right
    set Displacement x = )" +
           displacement +
           R"(
  end
end
subsection Control
  set End = 1
end
)";
  }

  std::string two_squares_scene()
  {
    return R"(set Kind = continuum
subsection Model
  set Dimension = 2
  set Plane     = stress
end
subsection Mesh
  set Source = file
  set File   = two.msh
end
subsection Materials
  subsection stone
    set Law = isotropic elastic
    subsection isotropic elastic
      set Young modulus = 40e9
      set Poisson ratio = 0
    end
  end
  subsection mortar
    set Law = isotropic elastic
    subsection isotropic elastic
      set Young modulus = 20e9
      set Poisson ratio = 0
    end
  end
end
subsection Boundary conditions
  subsection left
    set Displacement x = 0
    set Displacement y = 0
  end
  subsection right
    set Traction x = 2e6*t
  end
end
subsection Points
  subsection end
    set Position = 2, 0.5, 0
  end
end
subsection Control
  set First step = 0.5
end
)";
  }

  std::string two_squares_mesh()
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n4\n1 1 \"left\"\n1 2 \"right\"\n2 11 \"stone\"\n2 12 \"mortar\"\n$EndPhysicalNames\n"
           "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
           "$Elements\n4\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 3 2 11 1 1 2 5 4\n4 3 2 12 2 2 3 6 5\n$EndElements\n";
  }
} // namespace apps_tests
