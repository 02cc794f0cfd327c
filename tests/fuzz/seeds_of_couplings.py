"""Scenes in which something touches a solid or fills the same space: small ones, mutated by the fuzzing."""

import math

COUPLED = """set Kind = coupled
subsection Continuum
  subsection Model
    set Dimension = 3
  end
  subsection Mesh
    set Source = box
    subsection Box
      set Size        = 0.01, 0.01, 0.005
      set Divisions x = 3
      set Divisions y = 3
      set Divisions z = 2
      set Growth      = 1, 1.2, 0.8
    end
  end
  subsection Materials
    subsection solid
      set Law     = isotropic elastic
      set Density = 2000
      subsection isotropic elastic
        set Young modulus = 1e9
        set Poisson ratio = 0.2
      end
    end
  end
  subsection Boundary conditions
    subsection back
      set Displacement z = 0
    end
  end
  subsection Motion
    set Damping = 10
  end
end
subsection Particles
  subsection Specimen
    set Source  = none
    set Density = 2500
  end
  subsection More particles
    subsection ball
      set Centre = 0.005, 0.005, 0.0061
      set Radius = 1e-3
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
      set Velocity z = -1
    end
  end
end
subsection Couplings
  subsection top
    set Boundary          = front
    set Groups            = ball
    set Contact           = pressure
    set Effective modulus = 1e8
    set Energy limit      = 0.1
    subsection Bond
      set Within = 2e-4
      set Law    = parallel-bond
      subsection parallel-bond
        set Effective modulus = 1e8
        set Tensile strength  = 1e5
        set Cohesion          = 1e5
      end
    end
  end
end
subsection Gravity
  set Acceleration = 0, 0, -9.81
end
subsection Time
  set End time      = 2e-4
  set Largest ratio = 2
end
subsection Output
  set Samples   = 10
  set Snapshots = 1
end
"""

CONTACT = """set Kind = continuum
subsection Model
  set Dimension          = 3
  set Analysis           = explicit
  set Large displacement = true
end
subsection Mesh
  set Source = bodies
  subsection Boxes
    subsection base
      set Size        = 0.2, 0.2, 0.05
      set Divisions x = 3
      set Divisions y = 3
      set Material    = stone
    end
  end
  subsection Balls
    subsection ball
      set Centre      = 0.1, 0.1, 0.0902
      set Radius      = 0.04
      set Divisions   = 2
      set Towards     = 0, 0, -1
      set Fineness    = 8
      set Material    = stone
    end
  end
end
subsection Materials
  subsection stone
    set Law     = isotropic elastic
    set Density = 2400
    subsection isotropic elastic
      set Young modulus = 1e8
      set Poisson ratio = 0.2
    end
  end
end
subsection Motion
  set End time           = 1e-3
  set Initial velocity z = z > 0.05005 ? -1 : 0
  set Initial velocity x = z > 0.05005 ? 0.3 : 0
end
subsection Contacts
  subsection joint
    set Form                 = potential
    set Stiffness            = 4e10
    set Shear ratio          = 0.8
    set Friction coefficient = 0.4
  end
end
subsection Output
  set Samples   = 10
  set Snapshots = 1
end
"""


def hexagonal(radius=0.005, length=0.3, height=0.06):
    """Discs in a beam about the origin, as text: x y z radius."""
    pitch = math.sqrt(3) * radius
    rows = int((height - 2 * radius) / pitch) + 1
    lines = []
    for row in range(rows):
        first = -length / 2 + radius * (1 + row % 2)
        for n in range(int((length / 2 - radius - first) / (2 * radius) + 1.5)):
            lines.append(f"{first + 2 * radius * n:.9g} {radius + pitch * row:.9g} 0 {radius}")
    return "\n".join(lines) + "\n"


BEAM_OF_ELEMENTS = """  subsection Model
    set Dimension = 2
    set Plane     = stress
    set Thickness = 0.01
  end
  subsection Mesh
    set Source = bodies
    subsection Boxes
      subsection beam
        set Corner      = -0.15, 0, 0
        set Size        = 0.3, 0.06, 0
        set Divisions x = 10
        set Divisions y = 2
        set Material    = concrete
      end
    end
  end
"""

HANDSHAKE = """set Kind = coupled
subsection Continuum
""" + BEAM_OF_ELEMENTS + """  subsection Materials
    subsection concrete
      set Law     = isotropic elastic
      set Density = 2000
      subsection isotropic elastic
        set Young modulus = 1e9
        set Poisson ratio = 0.2
      end
    end
  end
  subsection Boundary conditions
    subsection beam left
      set Displacement x = 0
      set Displacement y = 0
    end
  end
end
subsection Particles
  subsection Physics
    set Dimension = 2
  end
  subsection Specimen
    set Source            = file
    set File              = hexagonal.txt
    set Density           = 2000
    set Thickness         = 0.01
    set Interaction ratio = 1.5
  end
  subsection More particles
    subsection impactor
      set Centre = 0, 0.0634, 0
      set Radius = 0.01
    end
  end
  subsection Material
    set Law = CPM
    subsection CPM
      set Normal modulus       = 785.4e6
      set Shear ratio          = 0.25
      set Limit elastic strain = 3e-3
      set Relative ductility   = 100
      set Cohesion             = 78.54e6
      set Friction coefficient = 0
    end
  end
  subsection Initial velocity
    subsection impactor
      set Velocity y = -5
    end
  end
end
subsection Handshakes
  subsection core
    set Low          = -0.03, -1, -1
    set High         = 0.03, 1, 1
    set Overlap      = 0.05
    set Method       = multipliers
    set Energy limit = 0.1
  end
end
subsection Time
  set End time    = 1e-4
  set Step factor = 0.5
end
subsection Output
  set Samples   = 10
  set Snapshots = 1
end
"""

TRANSMISSION = """set Kind = transmission
subsection Waves
  set Medium         = chain
  set Spacing        = 0.01
  set Normal modulus = 25e9
  set Density        = 2400
  set Element size   = 4
  set Overlap        = 4
  set Methods        = absorber, constrained
  set Wavelengths    = 0.08, 0.16
  set Layer          = 2
end
"""


STRUCTURE = """set Kind = structure
subsection Specimen
  set Source            = file
  set File              = hexagonal.txt
  set Thickness         = 0.01
  set Interaction ratio = 1.5
end
subsection Material
  set Law = CPM
  subsection CPM
    set Normal modulus       = 785.4e6
    set Shear ratio          = 0.25
    set Limit elastic strain = 3e-4
    set Relative ductility   = 20
    set Cohesion             = 78.54e6
    set Friction coefficient = 0
  end
end
subsection Physics
  set Dimension = 2
end
subsection Voids
  subsection notch
    set Shape = box
    set Lower = -0.004, -1, -1
    set Upper = 0.004, 0.02, 1
  end
end
subsection Groups
  subsection load
    set Shape = box
    set Lower = -0.008, 0.045, -1
    set Upper = 0.008, 1, 1
  end
end
subsection Supports
  subsection load
    set Displacement x = 0
    set Displacement y = -t
  end
end
subsection Continuum
""" + BEAM_OF_ELEMENTS + """  subsection Materials
    subsection concrete
      set Law = isotropic elastic
      subsection isotropic elastic
        set Young modulus = 1e9
        set Poisson ratio = 0.2
      end
    end
  end
  subsection Supports
    subsection left
      set From           = -0.15, 0, 0
      set Displacement y = 0
    end
    subsection right
      set From           = 0.15, 0, 0
      set Displacement y = 0
    end
  end
end
subsection Handshakes
  subsection core
    set Low     = -0.03, -1, -1
    set High    = 0.03, 1, 1
    set Overlap = 0.03
  end
end
subsection Path
  set End  = 1e-4
  set Step = 1e-5
end
subsection Output
  set Points per snapshot = 5
end
"""
