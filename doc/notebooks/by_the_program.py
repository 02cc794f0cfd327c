"""What the program answers to the question of a notebook, for comparison to the last bit.

The program is build/release/apps/breccia of this repository, or what the environment says in BRECCIA_PROGRAM.
"""

import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile
from types import SimpleNamespace

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "apps" / "scenes"
PROGRAM = os.environ.get("BRECCIA_PROGRAM", str(ROOT / "build" / "release" / "apps" / "breccia"))


def do(*words):
    """A command of the program, from its words. Raises CalledProcessError."""
    subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True)


def columns_of(file):
    """Columns of a table as lists of numbers (words where they are none), by name."""
    with open(file) as text:
        names, *rows = csv.reader(line for line in text if not line.startswith("#"))

    def number(value):
        try:
            return float(value)
        except ValueError:
            return value

    names = [re.fullmatch(r"(.*?)(?: \[.*\])?", name).group(1) for name in names]
    return {name: [number(row[c]) for row in rows] for c, name in enumerate(names)}


def run(scene):
    """The same scene, a breccia.Scene, run by the program: figures of its summary and columns of its series."""
    with tempfile.TemporaryDirectory() as folder:
        words = [word for change in scene.words for word in ("-s", change)]
        do("run", scene.file, "-o", f"{folder}/out", *words)
        summary = json.loads(pathlib.Path(folder, "out", "summary.json").read_text())
        table = pathlib.Path(folder, "out", "series.csv")
        return SimpleNamespace(figures=summary.get("figures", {}), columns=columns_of(table) if table.exists() else {})


def link_test(law, constants, path):
    """One link by the program: columns by name."""
    return _drive(["link-test", "--law", law], constants, path)


def point_test(material, constants, path):
    """One point of a continuum by the program: columns by name."""
    return _drive(["point-test", "--material", material], constants, path)


def _drive(command, constants, path):
    with tempfile.TemporaryDirectory() as folder:
        table, answer = f"{folder}/path.csv", f"{folder}/answer.csv"
        with open(table, "w") as text:
            text.write(",".join(path) + "\n")
            text.writelines(",".join(repr(float(value)) for value in row) + "\n" for row in zip(*path.values()))
        words = [word for name, value in constants.items() for word in ("-s", f"{name}={value!r}")]
        do(*command, *words, "--path", table, "-o", answer)
        return columns_of(answer)


def same(frame, columns):
    """Whether a frame has these columns to the last bit. Raises AssertionError that names the first that differs."""
    assert list(frame.columns) == list(columns), (list(frame.columns), list(columns))
    for name, values in columns.items():
        assert frame[name].tolist() == values, f"{name} differs"
    return True
