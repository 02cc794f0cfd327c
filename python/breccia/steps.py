"""A solid, and a solid with particles, advanced step by step."""

from types import SimpleNamespace

import numpy


class Solid:
    """The solid of a scene of kind "continuum" in explicit motion, which a program advances beside what its scene does to it.

    Nodes have numbers from 0. places, mass: of the undeformed solid, (n, 3) [m] and (n) [kg]. In the plane z is zero.
    """

    def __init__(self, moving):
        self._moving = moving
        self.places = moving.places()
        self.mass = moving.mass()

    @property
    def time(self):
        """Now [s]."""
        return self._moving.time

    @property
    def steps(self):
        """Taken since the start."""
        return self._moving.steps

    @property
    def time_step(self):
        """Of the next step, by itself that of a run [s]; may be set, up to longest_step. None: as a run again."""
        return self._moving.time_step

    @time_step.setter
    def time_step(self, step):
        self._moving.set_time_step(0.0 if step is None else step)

    @property
    def longest_step(self):
        """That is stable now, by the safety of the scene [s]."""
        return self._moving.longest_step

    @property
    def displacement(self):
        """Of the nodes now, (n, 3) [m]: a copy."""
        return self._moving.displacement()

    @property
    def velocity(self):
        """Of the nodes half a step back, (n, 3) [m/s]: a copy."""
        return self._moving.velocity()

    @property
    def values(self):
        """What the series of a run has besides the time, now, by the name of the column; units: self.units."""
        return {name: value for name, _, value in self._moving.values()}

    @property
    def units(self):
        """Of the values, by name."""
        return {name: unit for name, unit, _ in self._moving.values()}

    def nodes(self, boundary):
        """Numbers of the nodes on a boundary, an array, ascending. Raises InputError, which lists the boundaries there are."""
        return numpy.array(self._moving.nodes_on(boundary), dtype=int)

    def advance(self, steps=1):
        """Take steps; returns how many. Other threads go on; Ctrl-C ends after a step with KeyboardInterrupt. Raises NumericalError."""
        return self._moving.advance(steps)

    def advance_to(self, time):
        """Take steps up to a time [s], the last ones as long as fits. Otherwise as advance()."""
        return self._moving.advance_to(time)

    def add_force(self, node, force):
        """Push a node from outside in every step until clear_forces() [N]; several add up; work counts as external."""
        self._moving.add_force(node, force)

    def clear_forces(self):
        """Let go of all that add_force() pushes."""
        self._moving.clear_forces()

    def apply_impulse(self, node, change):
        """Change a node's velocity at once [m/s]."""
        self._moving.apply_impulse(node, change)

    def hold(self, nodes, along=(True, True, True)):
        """From now on these nodes move as set_velocity() says along x, y and z, at first not at all. Returns the group's number.
        Raises InputError where the scene prescribes their displacement."""
        return self._moving.hold(list(nodes), along)

    def set_velocity(self, group, velocity):
        """Of a held group [m/s]."""
        self._moving.set_velocity(group, velocity)

    def reaction(self, group):
        """Force that holds a group now, inertia not counted [N]."""
        return self._moving.reaction(group)

    def save(self):
        """Keep the present state in memory, histories and forces included; one at a time. Held groups are to be made before."""
        self._moving.save()

    def restore(self):
        """Back to it, as often as wanted: the same steps give the same bits."""
        self._moving.restore()


class CoupledRun:
    """A run of a scene of kind "coupled" that a program advances window by window: a window holds steps of both sides that end together.

    Without forces and impulses from outside its result is that of Scene.run() to the last bit. particles: arrays position, velocity, force
    (n, 3), radius, mass, number, broken_links (n), which show the particles as they are now, as of Particles. places: of the solid's
    nodes, undeformed (m, 3) [m].
    """

    def __init__(self, steps, result_of):
        self._steps = steps
        self._result_of = result_of
        self._result = None
        self.particles = SimpleNamespace(**steps.particles())
        self.places = steps.places()

    @property
    def time(self):
        """Now [s]."""
        return self._steps.time

    @property
    def windows(self):
        """Taken since the start."""
        return self._steps.windows

    @property
    def window(self):
        """That would be taken next [s]."""
        return self._steps.window

    @property
    def over(self):
        """Whether the run is at its end, has been stopped, or has failed."""
        return self._steps.over

    @property
    def row(self):
        """What a row of the series would have now, by the name of the column."""
        return {name: value for name, _, value in self._steps.row()}

    @property
    def units(self):
        """Of the row, by name."""
        return {name: unit for name, unit, _ in self._steps.row()}

    @property
    def interface_forces(self):
        """Of the particles on the solid at each surface coupling, by its name (3) [N]: those that acted over the last window."""
        return dict(self._steps.surface_forces())

    @property
    def displacement(self):
        """Of the solid's nodes now, (m, 3) [m]: a copy."""
        return self._steps.displacement()

    @property
    def velocity(self):
        """Of the solid's nodes half a step back, (m, 3) [m/s]: a copy."""
        return self._steps.velocity()

    def nodes(self, boundary):
        """Numbers of the solid's nodes on a boundary, an array, ascending. Raises InputError."""
        return numpy.array(self._steps.nodes_on(boundary), dtype=int)

    def step(self, windows=1):
        """Take windows; returns how many, fewer at the end. Other threads go on; Ctrl-C ends after some with KeyboardInterrupt, from where
        the run goes on. Raises NumericalError."""
        return self._steps.advance(windows)

    def advance_to(self, time):
        """Take windows until a time is reached or passed [s]; returns how many. Otherwise as step()."""
        return self._steps.advance_to(time)

    def add_force(self, particle, force, couple=(0, 0, 0)):
        """Push a particle from outside until clear_forces() [N, N m]; several add up. No checkpoint holds it."""
        self._steps.push_particle(particle, force, couple)

    def add_node_force(self, node, force):
        """Likewise a node of the solid [N]."""
        self._steps.push_node(node, force)

    def clear_forces(self):
        """Let go of all that is pushed from outside."""
        self._steps.clear_forces()

    def apply_impulse(self, particle, change, spin=(0, 0, 0)):
        """Change a particle's velocity at once [m/s, rad/s]."""
        self._steps.kick_particle(particle, change, spin)

    def apply_node_impulse(self, node, change):
        """Change the velocity of a node of the solid at once [m/s]."""
        self._steps.kick_node(node, change)

    def stop(self):
        """End here: with a folder, a checkpoint is saved, from which Scene.start(folder, resume=True) goes on. Returns the Result so far."""
        if self._result is None:
            self._result = self._result_of(self._steps.finish())
        return self._result

    def result(self):
        """Go on to the end, and return the Result. Raises as step()."""
        while self._result is None and not self._steps.over:
            self._steps.advance(1_000_000)
        return self.stop()
