"""Breccia from Python: scenes as dictionaries, runs as functions, results as arrays and tables. SI units throughout."""

import json
import os
from collections.abc import MutableMapping
from types import SimpleNamespace
from typing import NamedTuple, Optional

# Threads that wait for each other shall soon sleep; the library reads this when it is loaded.
os.environ.setdefault("GOMP_SPINCOUNT", "1000")

from . import _breccia  # noqa: E402
from ._breccia import InputError, NumericalError, OutputError  # noqa: E402
from .cells import Cell  # noqa: E402
from .drivers import homogenise, link_test, point_test  # noqa: E402
from .steps import CoupledRun, Solid  # noqa: E402
from .values import as_text, as_value  # noqa: E402

__version__ = _breccia.version
__all__ = ["Scene", "Particles", "Cell", "Solid", "CoupledRun", "Result", "Figure", "InputError", "NumericalError", "OutputError", "link_test",
           "point_test", "homogenise"]


class Figure(NamedTuple):
    """A number that a run found, or why there is none."""

    value: Optional[float]
    unit: str  # "-" of a pure number
    not_determined: str  # why there is no value; "" where there is one


class Scene(MutableMapping):
    """A scene file, whose entries are read and changed by their path: scene["Material/CPM/Cohesion"] = 3e6.

    Changes are checked together with the file by check(), run(), and whenever an entry is read: a wrong one raises InputError with the
    words of the terminal, where a change counts as one of option -s. The file stays as it is.
    """

    def __init__(self, file, changes=None):
        self.file = os.fspath(file)
        self._changes = {}
        self.update(changes or {})
        self._entries()  # refuses what cannot be read

    @property
    def words(self):
        """The changes as option -s of the program takes them, a list of "Section/Entry=value"."""
        return [f"{path}={value}" for path, value in self._changes.items()]

    def _entries(self):
        return {path: rest for path, *rest in _breccia.entries(self.file, self.words)}

    def __getitem__(self, path):
        value, unit, kind, _ = self._entries()[path]
        return as_value(value, unit, kind)

    def __setitem__(self, path, value):
        self._changes[path] = as_text(value)

    def __delitem__(self, path):
        """Back to what the file says."""
        del self._changes[path]

    def __iter__(self):
        return iter(self._entries())

    def __len__(self):
        return len(self._entries())

    def unit(self, path):
        """Of an entry; "-" of a pure number, "" of what is none."""
        return self._entries()[path][1]

    def meaning(self, path):
        """Of an entry, a sentence."""
        return self._entries()[path][3]

    def check(self):
        """What a run would take, in the words of `breccia check`. Raises InputError."""
        return _breccia.forecast(self.file, self.words)

    def run(self, folder=None, on_sample=None, resume=False):
        """Run to the end.

        folder: for the files of the run; None writes none. on_sample: called with a dictionary for each row of the series; a true
        answer stops the run. resume: go on from the checkpoint in the folder. Ctrl-C saves a checkpoint there and raises
        KeyboardInterrupt. Raises InputError, NumericalError, OutputError.
        """
        folder = "" if folder is None else os.fspath(folder)
        return Result(_breccia.run(self.file, self.words, folder, resume, on_sample))

    def particles(self):
        """The particles of a scene of kind "particles", to be moved step by step: Particles. Raises InputError."""
        return Particles(_breccia.MovingParticles(self.file, self.words))

    def solid(self):
        """The solid of a scene of kind "continuum" in explicit motion, to be moved step by step: Solid. Raises InputError."""
        return Solid(_breccia.MovingSolid(self.file, self.words))

    def start(self, folder=None, resume=False):
        """Begin a run of a scene of kind "coupled", which is then advanced step by step: CoupledRun. folder, resume: as of run().
        Raises InputError, OutputError."""
        folder = "" if folder is None else os.fspath(folder)
        return CoupledRun(_breccia.CoupledSteps(self.file, self.words, folder, resume), Result)


class Particles:
    """Particles that a program moves step by step, beside what their scene does to them. Numbers are those of the packing, from 0.

    position, velocity, force (n, 3), radius, mass, number, broken_links (n): arrays that show the particles as they are now, without
    copies; they follow every step and cannot be written to. Their order is the program's own: number says which particle of the packing
    each is. Positions [m], velocities half a step back [m/s], forces at the start of the last step [N].
    """

    def __init__(self, moving):
        self._moving = moving
        for name, view in moving.views().items():
            setattr(self, name, view)

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
        """In use [s]; may be set, up to longest_step."""
        return self._moving.time_step

    @time_step.setter
    def time_step(self, step):
        self._moving.set_time_step(step)

    @property
    def longest_step(self):
        """That may be set now [s]."""
        return self._moving.longest_step

    @property
    def energies(self):
        """By name [J], and balance_error [-]."""
        return self._moving.energies()

    def advance(self, steps=1):
        """Take steps. Other threads go on; Ctrl-C ends after a step with KeyboardInterrupt. Raises NumericalError."""
        return self._moving.advance(steps)

    def add_force(self, particle, force, couple=(0, 0, 0)):
        """Push a particle from outside in every step until clear_forces() [N, N m]; several add up; work counts as external."""
        self._moving.add_force(particle, force, couple)

    def clear_forces(self):
        """Let go of all that add_force() pushes."""
        self._moving.clear_forces()

    def apply_impulse(self, particle, change, spin=(0, 0, 0)):
        """Change a particle's velocity at once [m/s, rad/s]."""
        self._moving.apply_impulse(particle, change, spin)

    def hold(self, particles, along=(True,) * 6):
        """From now on these move as set_velocity() says along x, y, z and about them, at first not at all. Returns the group's number."""
        return self._moving.hold(list(particles), along)

    def set_velocity(self, group, velocity, spin=(0, 0, 0)):
        """Of a held group [m/s, rad/s]."""
        self._moving.set_velocity(group, velocity, spin)

    def reaction(self, group):
        """Force that holds a group, at the start of the last step [N]."""
        return self._moving.reaction(group)

    def links(self):
        """The links as they are now, as of Result.links(): copies."""
        return SimpleNamespace(**self._moving.links())

    def save(self):
        """Keep the present state in memory, histories included; one at a time. Held groups are to be made before."""
        self._moving.save()

    def restore(self):
        """Back to it, as often as wanted: the same steps give the same bits."""
        self._moving.restore()


class Result:
    """What a run found, in memory."""

    def __init__(self, found):
        self._found = found

    @property
    def complete(self):
        """Whether it came to its end; False: it was stopped, and has neither figures nor summary."""
        return self._found.complete

    @property
    def folder(self):
        """Of its files; "" where none were asked for."""
        return self._found.folder

    @property
    def go_on(self):
        """The command that goes on with a run that was stopped; "" where no checkpoint was left."""
        return self._found.go_on

    @property
    def words(self):
        """The findings as lines for a terminal."""
        return self._found.words

    @property
    def warnings(self):
        """What should be doubted, a sentence each."""
        return self._found.warnings

    @property
    def balance_error(self):
        """Of the energies, over the largest of them, at worst [-]; None where none are counted."""
        return self._found.balance_error

    @property
    def summary(self):
        """What summary.json holds, as a dictionary."""
        return json.loads(self._found.summary)

    @property
    def columns(self):
        """The series as arrays (of words: lists) by the name of the column; numbers are not copied and cannot be written to."""
        return {name: values for name, _, values in self._found.series()}

    @property
    def series(self):
        """The series as a pandas frame; series.attrs["units"] has the units by the name of the column."""
        import pandas

        found = self._found.series()
        frame = pandas.DataFrame({name: values for name, _, values in found})
        frame.attrs["units"] = {name: unit for name, unit, _ in found}
        return frame

    @property
    def figures(self):
        """Every figure by its path in the summary, a Figure each."""
        return {path: Figure(*self._found.figure(path)) for path in self._found.figure_names()}

    def figure(self, path):
        """One of them. Raises InputError, which lists those there are."""
        return Figure(*self._found.figure(path))

    def particles(self, sample=-1):
        """Particles at the end, in the order of the packing: arrays position, displacement, velocity, angular_velocity (n, 3), radius,
        damage, broken_links, volume (n). None where there are none. Earlier samples are not kept: IndexError.
        """
        if sample != -1:
            raise IndexError(f"sample {sample}: a result keeps the particles of the end alone, -1")
        columns = self._found.particles()
        return None if columns is None else SimpleNamespace(**columns)

    def links(self):
        """Links at the end: arrays ends (n, 2), numbers of the packing; kind: 0 a bond, 1 a contact, 2 a bond that is gone; normal_force,
        shear_force [N], normal_stress, shear_stress [Pa], normal_strain, damage [-], dissipated [J] (n), tension positive. None where there
        are no particles.
        """
        columns = self._found.links()
        return None if columns is None else SimpleNamespace(**columns)
