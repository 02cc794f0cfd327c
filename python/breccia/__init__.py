"""Breccia from Python: scenes as dictionaries, runs as functions, results as arrays and tables. SI units throughout."""

import difflib
import json
import os
import sys
from collections.abc import Mapping, MutableMapping
from types import SimpleNamespace
from typing import NamedTuple, Optional

# Threads that wait for each other shall soon sleep; the library reads this when it is loaded.
os.environ.setdefault("GOMP_SPINCOUNT", "1000")

try:
    import numpy  # noqa: F401

    from . import _breccia
except ImportError as missing:
    raise ImportError(f"breccia is built for Debian's Python, /usr/bin/python3; in this one, {sys.executable}: {missing}") from missing

from ._breccia import InputError, NumericalError, OutputError  # noqa: E402
from .cells import Cell  # noqa: E402
from .drivers import homogenise, link_test, point_test  # noqa: E402
from .steps import CoupledRun, Particles, Solid  # noqa: E402
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
        if changes is not None and not isinstance(changes, Mapping):
            raise InputError(f"changes = {changes!r}: expected a dictionary of values by the paths of entries.")
        self.update(changes or {})
        self._entries()  # refuses what cannot be read

    @property
    def words(self):
        """The changes as option -s of the program takes them, a list of "Section/Entry=value"."""
        return [f"{path}={value}" for path, value in self._changes.items()]

    def _entries(self):
        return {path: rest for path, *rest in _breccia.entries(self.file, self.words)}

    def _entry(self, path):
        entries = self._entries()
        if path not in entries:
            near = difflib.get_close_matches(str(path), entries, 1)
            raise KeyError(f"{self.file} has no entry {path}." + (f" Did you mean {near[0]}?" if near else ""))
        return entries[path]

    def __getitem__(self, path):
        value, unit, kind, _ = self._entry(path)
        return as_value(value, unit, kind)

    def __setitem__(self, path, value):
        self._changes[path] = as_text(value)

    def __delitem__(self, path):
        """Back to what the file says."""
        if path not in self._changes:
            raise KeyError(f"{path} has not been changed.")
        del self._changes[path]

    def __iter__(self):
        return iter(self._entries())

    def __len__(self):
        return len(self._entries())

    def unit(self, path):
        """Of an entry; "-" of a pure number, "" of what is none."""
        return self._entry(path)[1]

    def meaning(self, path):
        """Of an entry, a sentence."""
        return self._entry(path)[3]

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
        if on_sample is not None and not callable(on_sample):
            raise InputError(f"on_sample = {on_sample!r}: expected a function of a row of the series.")
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
        """Of its files; "" where none were requested."""
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
