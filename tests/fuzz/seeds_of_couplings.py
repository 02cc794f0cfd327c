"""Scenes in which something touches a solid: small ones, mutated by the fuzzing."""

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
