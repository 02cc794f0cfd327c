"""Particles, or the surface of a solid, as a participant of preCICE 3 (doc/tutorials/precice.md).

What is needed of preCICE comes from outside, an object of its own Python bindings, precice.Participant, so that nothing here has to be built
with it or installed for it.
"""

import math

import numpy

from . import Particles, Solid
from ._breccia import InputError

MOTION = ("displacement", "velocity")


def couple(interface, body, mesh, carriers, reads, writes, on_window=None):
    """Go through a coupled simulation to its end.

    interface: precice.Participant, not initialised yet. body: Solid or Particles, as a scene makes them. mesh: name of the mesh whose
    vertices are the carriers: numbers of nodes (Solid.nodes()) or of particles, at their places now. reads, writes: what the data of the mesh
    are, {"Force": "force"}, {"Displacement": "displacement", "Velocity": "velocity"}.

    Either "force" is read, which pushes the carriers during the whole time window (a conservative map keeps its sum), and motion is written; or
    "displacement" or "velocity" (consistent maps), to which the carriers are driven evenly, and "force" is written: that of the body on what drives
    it. Displacements count from the start of the coupling [m], velocities are half a step back [m/s]. A window has as many own steps of
    the body as its stability needs. Where the coupling is implicit, the body's state is saved and set back. on_window: called with the body at
    the end of each window that stands. Raises InputError for other data, and NumericalError.
    """
    side = _side_of(body, mesh, list(carriers), reads, writes)
    dimensions = interface.get_mesh_dimensions(mesh)
    ids = interface.set_mesh_vertices(mesh, side.places[:, :dimensions])
    if interface.requires_initial_data():
        _write(interface, side, mesh, ids, writes, dimensions)
    interface.initialize()
    while interface.is_coupling_ongoing():
        if interface.requires_writing_checkpoint():
            side.save()
        window = interface.get_max_time_step_size()
        for name, quantity in reads.items():
            values = numpy.zeros((len(side.carriers), 3))
            values[:, :dimensions] = interface.read_data(mesh, name, ids, window)
            side.take(quantity, values, window)
        side.advance(window)
        _write(interface, side, mesh, ids, writes, dimensions)
        interface.advance(window)
        if interface.requires_reading_checkpoint():
            side.restore()
        elif on_window:
            on_window(body)
    interface.finalize()


def _side_of(body, mesh, carriers, reads, writes):
    read, written = set(reads.values()), set(writes.values())
    if not carriers:
        raise InputError(f"{mesh}: has no carriers.")
    if read == {"force"} and written <= set(MOTION):
        driven = False
    elif len(read) == 1 and read <= set(MOTION) and written <= {"force"}:
        driven = True
    else:
        raise InputError(
            f'{mesh}: reads {_words(read)} and writes {_words(written)}. Read "force" and write "displacement" or "velocity", or read one of '
            'these and write "force".'
        )
    if isinstance(body, Solid):
        return _SolidSide(body, carriers, driven)
    if isinstance(body, Particles):
        return _ParticleSide(body, carriers, driven)
    raise InputError(f"{mesh}: expected a Solid or Particles, found {type(body).__name__}.")


def _words(quantities):
    return " and ".join(f'"{quantity}"' for quantity in sorted(quantities)) or "nothing"


def _write(interface, side, mesh, ids, writes, dimensions):
    for name, quantity in writes.items():
        interface.write_data(mesh, name, ids, side.shows(quantity)[:, :dimensions])


class _Side:
    """What is the same of both: carriers that are pushed, or driven one by one."""

    def __init__(self, body, carriers, driven):
        self.body, self.carriers = body, carriers
        self.places = self.positions()
        self.groups = [self.hold(carrier) for carrier in carriers] if driven else []

    def shows(self, quantity):
        if quantity == "displacement":
            return self.positions() - self.places
        if quantity == "velocity":
            return self.velocities()
        return numpy.array([-numpy.asarray(self.body.reaction(group)) for group in self.groups])

    def take(self, quantity, values, window):
        if quantity == "force":
            self.body.clear_forces()
            for carrier, force in zip(self.carriers, values):
                self.body.add_force(carrier, force)
            return
        velocities = values if quantity == "velocity" else (self.places + values - self.positions()) / window
        for group, velocity in zip(self.groups, velocities):
            self.body.set_velocity(group, velocity)

    def advance(self, window):
        steps = max(1, math.ceil(window / self.body.longest_step * (1 - 1e-12)))
        self.body.time_step = min(window / steps, self.body.longest_step)
        self.body.advance(steps)

    def save(self):
        self.body.save()

    def restore(self):
        self.body.restore()


class _SolidSide(_Side):
    def hold(self, node):
        return self.body.hold([node])

    def positions(self):
        return self.body.places[self.carriers] + self.body.displacement[self.carriers]

    def velocities(self):
        return self.body.velocity[self.carriers]


class _ParticleSide(_Side):
    def rows(self):
        row_of = {int(number): row for row, number in enumerate(self.body.number)}  # the order may change on the way
        return [row_of[carrier] for carrier in self.carriers]

    def hold(self, particle):
        return self.body.hold([particle], (True, True, True, False, False, False))

    def positions(self):
        return self.body.position[self.rows()].copy()

    def velocities(self):
        return self.body.velocity[self.rows()].copy()
