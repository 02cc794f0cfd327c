"""Particles, a solid, and a solid with particles, advanced step by step."""

from types import SimpleNamespace

import numpy

from .arguments import number, switches, three, whole, wholes


class _Moving:
    """What is the same of particles and a solid that a program moves step by step, beside what their scene does to them."""

    def __init__(self, moving):
        self._moving = moving

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
        """Of the next step [s]; may be set, up to longest_step. Of a solid by itself that of a run; None: as a run again."""
        return self._moving.time_step

    @time_step.setter
    def time_step(self, step):
        self._moving.set_time_step(0.0 if step is None else number("time_step", step))

    @property
    def longest_step(self):
        """That is stable now, by the safety of the scene [s]."""
        return self._moving.longest_step

    def advance(self, steps=1):
        """Take steps; returns how many. Other threads go on; Ctrl-C ends after a step with KeyboardInterrupt. Raises NumericalError."""
        return self._moving.advance(whole("steps", steps))

    def clear_forces(self):
        """Let go of all that add_force() pushes."""
        self._moving.clear_forces()

    def reaction(self, group):
        """Force that holds a group [N], inertia not counted: at the start of the last step of particles, of a solid now."""
        return self._moving.reaction(whole("group", group))

    def save(self):
        """Keep the present state in memory, histories included; one at a time. Held groups are to be made before."""
        self._moving.save()

    def restore(self):
        """Back to it, as often as wanted: the same steps give the same bits."""
        self._moving.restore()


class Particles(_Moving):
    """Particles of a scene, which a program moves. Numbers are those of the packing, from 0.

    position, velocity, force (n, 3), radius, mass, number, broken_links (n): arrays that show the particles as they are now, without
    copies; they follow every step and cannot be written to. Their order is the program's own: number says which particle of the packing
    each is. Positions [m], velocities half a step back [m/s], forces at the start of the last step [N].
    """

    def __init__(self, moving):
        super().__init__(moving)
        for name, view in moving.views().items():
            setattr(self, name, view)

    @property
    def energies(self):
        """By name [J], and balance_error [-]."""
        return self._moving.energies()

    def add_force(self, particle, force, couple=(0, 0, 0)):
        """Push a particle from outside in every step until clear_forces() [N, N m]; several add up; work counts as external."""
        self._moving.add_force(whole("particle", particle), three("force", force), three("couple", couple))

    def apply_impulse(self, particle, change, spin=(0, 0, 0)):
        """Change a particle's velocity at once [m/s, rad/s]."""
        self._moving.apply_impulse(whole("particle", particle), three("change", change), three("spin", spin))

    def hold(self, particles, along=(True,) * 6):
        """From now on these move as set_velocity() says along x, y, z and about them, at first not at all. Returns the group's number."""
        return self._moving.hold(wholes("particles", particles), switches("along", along, 6))

    def set_velocity(self, group, velocity, spin=(0, 0, 0)):
        """Of a held group [m/s, rad/s]."""
        self._moving.set_velocity(whole("group", group), three("velocity", velocity), three("spin", spin))

    def links(self):
        """The links as they are now, as of Result.links(): copies."""
        return SimpleNamespace(**self._moving.links())


class Solid(_Moving):
    """The solid of a scene of kind "continuum" in explicit motion, which a program moves.

    Nodes have numbers from 0. places, mass: of the undeformed solid, (n, 3) [m] and (n) [kg]. In the plane z is zero.
    """

    def __init__(self, moving):
        super().__init__(moving)
        self.places = moving.places()
        self.mass = moving.mass()

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

    def advance_to(self, time):
        """Take steps up to a time [s], the last ones as long as fits. Otherwise as advance()."""
        return self._moving.advance_to(number("time", time))

    def add_force(self, node, force):
        """Push a node from outside in every step until clear_forces() [N]; several add up; work counts as external."""
        self._moving.add_force(whole("node", node), three("force", force))

    def apply_impulse(self, node, change):
        """Change a node's velocity at once [m/s]."""
        self._moving.apply_impulse(whole("node", node), three("change", change))

    def hold(self, nodes, along=(True, True, True)):
        """From now on these nodes move as set_velocity() says along x, y and z, at first not at all. Returns the group's number.
        Raises InputError where the scene prescribes their displacement."""
        return self._moving.hold(wholes("nodes", nodes), switches("along", along, 3))

    def set_velocity(self, group, velocity):
        """Of a held group [m/s]."""
        self._moving.set_velocity(whole("group", group), three("velocity", velocity))


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
        return self._steps.advance(whole("windows", windows))

    def advance_to(self, time):
        """Take windows until a time is reached or passed [s]; returns how many. Otherwise as step()."""
        return self._steps.advance_to(number("time", time))

    def add_force(self, particle, force, couple=(0, 0, 0)):
        """Push a particle from outside until clear_forces() [N, N m]; several add up. No checkpoint holds it."""
        self._steps.push_particle(whole("particle", particle), three("force", force), three("couple", couple))

    def add_node_force(self, node, force):
        """Likewise a node of the solid [N]."""
        self._steps.push_node(whole("node", node), three("force", force))

    def clear_forces(self):
        """Let go of all that is pushed from outside."""
        self._steps.clear_forces()

    def apply_impulse(self, particle, change, spin=(0, 0, 0)):
        """Change a particle's velocity at once [m/s, rad/s]."""
        self._steps.kick_particle(whole("particle", particle), three("change", change), three("spin", spin))

    def apply_node_impulse(self, node, change):
        """Change the velocity of a node of the solid at once [m/s]."""
        self._steps.kick_node(whole("node", node), three("change", change))

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
