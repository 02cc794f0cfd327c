"""Scenes of solids that are mutated; as small as they can be and still run."""

CONTINUUM_STATIC = """set Kind = continuum
subsection Model
  set Dimension = 2
  set Plane     = stress
  set Thickness = 0.1
end
subsection Mesh
  set Source = file
  set File   = two.msh
end
subsection Materials
  subsection stone
    set Law = damage-plastic concrete
    subsection damage-plastic concrete
      set Young modulus        = 30e9
      set Poisson ratio        = 0.2
      set Compressive strength = 30e6
      set Tensile strength     = 3e6
      set Fracture energy      = 100
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
    set Displacement x = 2e-5*t
  end
end
subsection Points
  subsection end
    set Position = 0.02, 0.005, 0
  end
end
subsection Control
  set First step = 0.25
end
subsection Output
  set Snapshots        = 1
  set Curve horizontal = displacement_end_x
  set Curve vertical   = reaction_right_x
end
"""

CONTINUUM_EXPLICIT = """set Kind = continuum
subsection Model
  set Dimension = 3
  set Analysis  = explicit
end
subsection Mesh
  set Source = box
  subsection Box
    set Size        = 0.05, 0.02, 0.02
    set Divisions x = 5
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
    set Position = 0.05, 0.01, 0.01
  end
end
subsection Motion
  set End time           = 4e-5
  set Initial velocity x = -10
end
subsection Output
  set Samples   = 20
  set Snapshots = 2
end
"""
