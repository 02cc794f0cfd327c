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

__version__ = _breccia.version
__all__ = ["Scene", "Result", "Figure", "InputError", "NumericalError", "OutputError"]


class Figure(NamedTuple):
    """A number that a run found, or why there is none."""

    value: Optional[float]
    unit: str  # "-" of a pure number
    not_determined: str  # why there is no value; "" where there is one


def _as_text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "__iter__"):
        return ", ".join(_as_text(each) for each in value)
    return repr(value.item() if hasattr(value, "item") else value)  # every bit of a number


def _as_value(text, unit, kind):
    if text == "":
        return None
    if unit:  # it may stand behind the number
        text = text.removesuffix(f" {unit}")
    if kind == "number":
        return float(text)
    if kind == "whole number":
        return int(text)
    if kind == "switch":
        return text.lower() == "true"
    if kind == "three numbers":
        return tuple(float(each) for each in text.split(","))
    return text


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

    def _words(self):
        return [f"{path}={value}" for path, value in self._changes.items()]

    def _entries(self):
        return {path: rest for path, *rest in _breccia.entries(self.file, self._words())}

    def __getitem__(self, path):
        value, unit, kind, _ = self._entries()[path]
        return _as_value(value, unit, kind)

    def __setitem__(self, path, value):
        self._changes[path] = _as_text(value)

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
        return _breccia.forecast(self.file, self._words())

    def run(self, folder=None, on_sample=None, resume=False):
        """Run to the end.

        folder: for the files of the run; None writes none. on_sample: called with a dictionary for each row of the series; a true
        answer stops the run. resume: go on from the checkpoint in the folder. Ctrl-C saves a checkpoint there and raises
        KeyboardInterrupt. Raises InputError, NumericalError, OutputError.
        """
        folder = "" if folder is None else os.fspath(folder)
        return Result(_breccia.run(self.file, self._words(), folder, resume, on_sample))


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

        frame = pandas.DataFrame(self.columns)
        frame.attrs["units"] = {name: unit for name, unit, _ in self._found.series()}
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
