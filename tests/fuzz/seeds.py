"""Sound inputs to begin with: small enough that the program answers each within a second."""

import math

from seeds_of_solids import CONTINUUM_EXPLICIT, CONTINUUM_STATIC
from seeds_of_couplings import CONTACT, COUPLED, HANDSHAKE, STRUCTURE, TRANSMISSION, hexagonal

CPM = """  set Law = CPM
  subsection CPM
    set Normal modulus       = 25e9
    set Shear ratio          = 0.2
    set Limit elastic strain = 1e-4
    set Relative ductility   = 30
    set Cohesion             = 3e6
    set Friction coefficient = 0.8
  end
"""

SPECIMEN = """subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Density           = 4800
  set Interaction ratio = 1.5
end
"""

UNIAXIAL = f"""set Kind = uniaxial
{SPECIMEN}subsection Material
{CPM}end
subsection Loading
  set Grip thickness = 0.5e-3
  subsection Tension
    set Strain rate = 20
  end
  subsection Compression
    set Strain rate = 100 1/s
  end
end
subsection Output
  set Samples   = 20
  set Snapshots = 2
end
"""

CELL = f"""set Kind = cell
{SPECIMEN.replace("packing.txt", "cell.txt")}subsection Material
{CPM}end
subsection Time
  set Damping = 0.3
end
subsection Loading
  set Legs = 2
  subsection Leg 1
    set Duration = 5e-5
    set xx       = stress -1e6
  end
  subsection Leg 2
    set Duration = 1e-4
    set xx       = strain 5e-4
    set yy       = stress -1e5
  end
end
subsection Output
  set Samples   = 20
  set Snapshots = 2
end
"""

QUASI_STATIC = f"""set Kind = quasi_static
subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Interaction ratio = 1.5
end
subsection Material
{CPM}end
subsection Loading
  set Tests          = tension
  set Grip thickness = 0.5e-3
  subsection Tension
    set Strain step   = 2e-5
    set Stop fraction = 0.7
  end
end
subsection Output
  set Points per snapshot = 20
end
"""

HOMOGENISATION = """set Kind = homogenisation
subsection Homogenisation
  set Source             = file
  set File               = cell.txt
  set Normal modulus     = 25e9
  set Interaction ratios = 1.4, 1.5
  set Shear ratios       = 0.2, 1
end
"""

GENERATED = f"""set Kind = uniaxial
subsection Specimen
  set Source            = generator
  set Box size          = 0.008, 0.008, 0.012
  set Density           = 4800
  set Interaction ratio = 1.5
  subsection Generator
    set Particle radius = 1e-3
    set Cell particles  = 60
    set Faces           = cut
    set Seed            = 3
  end
end
subsection Materials
  subsection mortar
{CPM.replace("  set", "    set").replace("  sub", "    sub").replace("  end", "    end")}  end
  subsection stone
{CPM.replace("  set", "    set").replace("  sub", "    sub").replace("  end", "    end")}    set Density = 6000
  end
end
subsection Regions
  subsection grain
    set Shape    = sphere
    set Centre   = 0.004, 0.004, 0.006
    set Radius   = 0.003
    set Material = stone
  end
end
subsection Gravity
  set Acceleration = 0, 0, -9.81
end
subsection Loading
  set Tests          = compression
  set Axis           = z
  set Grip thickness = 2.2e-3
  subsection Compression
    set Strain rate = 200 1/s
  end
end
subsection Output
  set Samples   = 20
  set Snapshots = 0
end
"""

SEQUENTIAL = f"""set Kind = sequential
subsection Particles
  set Source = uniaxial
  subsection Specimen
    set Source            = file
    set File              = packing.txt
    set Density           = 4800
    set Interaction ratio = 1.5
  end
  subsection Material
{CPM}  end
  subsection Uniaxial
    set Strain rate    = 100 1/s
    set Grip thickness = 0.5e-3
    set Instants       = -4e-4, -1.5e-3
    set End strain     = 0
  end
end
subsection Transfer
  set Kernel = specimen
end
subsection Continuum
  subsection Model
    set Dimension = 3
  end
  subsection Mesh
    set Source = box
    subsection Box
      set Size = 0.011, 0.010, 0.012
    end
  end
  subsection Materials
    subsection solid
      set Law = damage-plastic concrete
      subsection damage-plastic concrete
        set Young modulus        = 33e9
        set Poisson ratio        = 0.2
        set Compressive strength = 40e6
        set Tensile strength     = 1e6
        set Fracture energy      = 100
        set Softening A          = 6
        set Element size         = 2
        set Reference size       = 2
      end
    end
  end
  subsection Boundary conditions
    subsection left
      set Displacement x = 0
    end
    subsection bottom
      set Displacement y = 0
    end
    subsection back
      set Displacement z = 0
    end
    subsection front
      set Displacement z = -0.012*t
    end
  end
  subsection Points
    subsection top
      set Position = 0, 0, 0.012
    end
  end
  subsection Control
    set End           = 1e-3
    set First step    = 2e-4
    set Relax         = true
    set Tolerance     = 1e-6
  end
  subsection Output
    set Snapshots        = 1
    set Curve horizontal = displacement_top_z
    set Curve vertical   = reaction_front_z
  end
end
subsection Study
  set Length     = 0.012
  set Area       = 1.1e-4
  set Horizontal = displacement_top_z
  set Vertical   = reaction_front_z
end
"""

MESH_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "left"
1 2 "right"
2 11 "stone"
2 12 "mortar"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 0.01 0 0
3 0.02 0 0
4 0 0.01 0
5 0.01 0.01 0
6 0.02 0.01 0
$EndNodes
$Elements
4
1 1 2 1 1 1 4
2 1 2 2 2 3 6
3 3 2 11 1 1 2 5 4
4 3 2 12 2 2 3 6 5
$EndElements
"""

MESH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "left"
1 2 "right"
2 11 "stone"
2 12 "mortar"
$EndPhysicalNames
$Entities
0 2 2 0
1 0 0 0 0 0.01 0 1 1 0
2 0.02 0 0 0.02 0.01 0 1 2 0
1 0 0 0 0.01 0.01 0 1 11 0
2 0.01 0 0 0.02 0.01 0 1 12 0
$EndEntities
$Nodes
2 6 1 6
2 1 0 4
1
2
5
4
0 0 0
0.01 0 0
0.01 0.01 0
0 0.01 0
2 2 0 2
3
6
0.02 0 0
0.02 0.01 0
$EndNodes
$Elements
4 4 1 4
1 1 1 1
1 1 4
1 2 1 1
2 3 6
2 1 3 1
3 1 2 5 4
2 2 3 1
4 2 3 6 5
$EndElements
"""


def packing():
    """5 x 5 x 6 spheres of 1 mm in a close hexagonal stack, a little apart."""
    spacing, lines = 2.04e-3, ["# x y z radius [m]"]
    for k in range(6):
        for j in range(5):
            for i in range(5):
                lines.append(f"{spacing * (i + 0.5 * ((j + k) % 2)):.12g} "
                             f"{spacing * math.sqrt(3) / 2 * (j + (k % 2) / 3):.12g} "
                             f"{spacing * math.sqrt(2 / 3) * k:.12g} 1e-3")
    return "\n".join(lines) + "\n"


def periodic_cell():
    """27 spheres of 1 mm near a cubic lattice, periodic."""
    edge, lines = 5.7e-3, ["# periodic_cell 5.7e-3 5.7e-3 5.7e-3", "x y z radius"]
    for n in range(27):
        x = [edge / 3 * (place + 0.1 * math.sin(1 + 7 * n + d)) for d, place in
             enumerate((n % 3, n // 3 % 3, n // 9))]
        lines.append(" ".join(f"{v:.12g}" for v in x) + " 1e-3")
    return "\n".join(lines) + "\n"


LINK_PATH = """normal_strain, shear_strain_1, shear_strain_2
0, 0, 0
5e-5, 0, 0
2e-4, 1e-4, 0
-1e-4, 2e-4, 1e-4
1e-3, -2e-4, 0
"""

LINK_CONSTANTS = ["Normal modulus=25e9", "Shear ratio=0.2", "Limit elastic strain=1e-4", "Relative ductility=30",
                  "Cohesion=3e6", "Friction coefficient=0.8"]

POINT_PATH = """strain_xx, stress_yy, stress_zz
0, 0, 0
-2e-4, 0, 0
-1e-3, 0, -1e5
-3e-3, 0, -1e5
1e-4, 0, 0
"""

POINT_CONSTANTS = ["Young modulus=30e9", "Poisson ratio=0.2", "Compressive strength=30e6", "Tensile strength=3e6",
                   "Fracture energy=100", "Element size=0.05"]

PARTICLES = """set Kind = particles
subsection Specimen
  set Source            = file
  set File              = packing.txt
  set Density           = 2500
  set Interaction ratio = 1
end
subsection More particles
  subsection ball
    set Centre = 0.004, 0.004, 0.02
    set Radius = 1.5e-3
  end
end
subsection Material
  set Law = linear
  subsection linear
    set Effective modulus    = 1e7
    set Friction coefficient = 0.3
  end
end
subsection Groups
  subsection low
    set Members   = layer
    set Axis      = z
    set Thickness = 1e-3
  end
end
subsection Motion
  subsection low
    set Velocity z = 0.01*sin(100*t)
  end
end
subsection Forces
  subsection ball
    set Force x = 1e-3*t
  end
end
subsection Walls
  subsection floor
    set Shape             = plane
    set Point             = 0, 0, -2e-3
    set Normal            = 0, 0, 1
    set Effective modulus = 1e7
  end
  subsection lid
    set Shape             = plate
    set Corner            = -0.01, -0.01, 0.025
    set First edge        = 0.03, 0, 0
    set Second edge       = 0, 0.03, 0
    set Effective modulus = 1e7
    set Control           = force
    set Direction         = 0, 0, -1
    set Force             = 0.1
    set Largest speed     = 0.5
  end
end
subsection Gravity
  set Acceleration        = 0, 0, -9.81
  set Initial equilibrium = none
end
subsection Probes
  subsection press
    set Quantity  = wall force
    set Wall      = lid
    set Component = z
  end
end
subsection Stop
  subsection far
    set Column = time
    set Value  = 1
  end
end
subsection Time
  set End time = 2e-3
end
subsection Output
  set Samples   = 10
  set Snapshots = 1
end
"""

SCENES = {"uniaxial": UNIAXIAL, "cell": CELL, "quasi_static": QUASI_STATIC, "homogenisation": HOMOGENISATION,
          "generated": GENERATED, "continuum_static": CONTINUUM_STATIC, "continuum_explicit": CONTINUUM_EXPLICIT,
          "sequential": SEQUENTIAL, "particles": PARTICLES, "coupled": COUPLED, "contact": CONTACT,
          "handshake": HANDSHAKE, "transmission": TRANSMISSION, "structure": STRUCTURE}

FILES = {"packing.txt": packing(), "cell.txt": periodic_cell(), "hexagonal.txt": hexagonal(),
         "two.msh": MESH_2, "two4.msh": MESH_4, "link.csv": LINK_PATH, "point.csv": POINT_PATH}
