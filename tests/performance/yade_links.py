# Link updates per second of YADE (its CPM law: CpmMat, Law2_ScGeom_CpmPhys_Cpm) on one packing: run by beside_yade.sh.
#
#   yade -n -x -j1 yade_links.py PACKING STEPS        PACKING: text, x y z radius [m] a line
#
# The same material, particles, reach of links, damping and uniform expansion as `bench_kernel --elastic` has, whole steps of both:
# links, motion, search for contacts. Prints "LINKS RATE", the rate per second of processor time as the best of three.
import math
import sys
import time

packing, steps = sys.argv[1], int(sys.argv[2])
reach, rate = 1.5, 1e-2
concrete = CpmMat(young=25e9, poisson=0.2, density=4800, frictionAngle=math.atan(0.8), sigmaT=3e6, epsCrackOnset=1e-4, relDuctility=30)
for line in open(packing):
    if not line.startswith('#'):
        x, y, z, radius = (float(word) for word in line.split())
        particle = sphere((x, y, z), radius, material=concrete)
        particle.state.vel = (rate * x, rate * y, rate * z)
        particle.state.angVel = (1, -2, 0.5)
        O.bodies.append(particle)

near, touch = Bo1_Sphere_Aabb(aabbEnlargeFactor=reach), Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=reach)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([near]),
    InteractionLoop([touch], [Ip2_CpmMat_CpmMat_CpmPhys()], [Law2_ScGeom_CpmPhys_Cpm()]),
    NewtonIntegrator(damping=0.3),
]
O.dt = 0.3 * PWaveTimeStep()
O.step()  # makes the links; from here on what comes near is a contact
near.aabbEnlargeFactor = touch.interactionDetectionFactor = 1
O.run(5, True)
best = 0
for _ in range(3):
    links = sum(1 for link in O.interactions if link.isReal)
    start = time.process_time()
    O.run(steps, True)
    best = max(best, links * steps / (time.process_time() - start))
print(links, best)
