#!/usr/bin/env python3
"""Gives the program damaged and senseless input of every kind, and holds it to its word: whatever is typed, it answers with a
result or with a message.

Nothing may end by a signal, a hang, "a mistake in the program", or with status 0 and nan, inf or nothing where a figure was asked
for. Every mutation follows from the seed and its number alone, so that what was found can be done again:

    fuzz.py build/release/apps/breccia --seed 7 --mutations 1000
    fuzz.py build/release/apps/breccia --seed 7 --only 123 --keep case
"""

import argparse
import concurrent.futures
import json
import math
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import hdf5_bytes
import seeds

PATIENCE = 30  # s: then it is asked to stop
LEAVE = 60  # s to answer that, on a machine that is busy
MEMORY = 6 << 30  # bytes of address space: a model beyond must say so
SUCCESS, FAILURE, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

NASTY_NUMBERS = ["0", "-0", "-1", "1", "1e-300", "5e-324", "1e308", "-1e308", "1e300", "1e30", "1e12", "1e-12", "1e9", "-1e9",
                 "nan", "inf", "-inf", "1e999", "99999999999999999999", "18446744073709551616", "-9223372036854775808",
                 "2147483648", "0x10", "1,5", "3e", "+5", "1e5e5", "0.1", "0.5", "2", "3", "10", "100", "1000"]
NASTY_WORDS = ["", " ", "%s%n", "a" * 5000, "\u00e9\u4e2d", "\x00", "\x1b[31m", "-", "true", "none", "../../etc", "/dev/null", "."]
FORMULAS = ["y=1e-5*t", "1,5*t", "t/0", "sqrt(-1)", "log(0)", "1e308*10", "exp(1000*t)", "((((t", "t)", "t t", "x=t", "sin", "0*t"]


class Mutator:
    """Random changes of texts, bytes and numbers."""

    def __init__(self, rng):
        self.rng = rng

    def number(self, near="1"):
        if self.rng.random() < 0.6:
            return self.rng.choice(NASTY_NUMBERS)
        try:
            value = float(near)
        except ValueError:
            value = 1.0
        factor = self.rng.choice([0.0, -1.0, 0.5, 2.0, 10.0, 0.1, 1e3, 1e-3, 1e6, 1e-6, 1e15, 1e-15])
        return repr(value * factor)

    def value(self, near="1"):
        pick = self.rng.random()
        if pick < 0.65:
            return self.number(near)
        if pick < 0.75:
            return self.rng.choice(FORMULAS)
        if pick < 0.85:
            return ", ".join(self.number(near) for _ in range(self.rng.randint(1, 4)))
        return self.rng.choice(NASTY_WORDS)

    def lines(self, text, separators=r"[ ,\t]+"):
        """One change of a text made of lines."""
        lines = text.split("\n")
        at = self.rng.randrange(len(lines))
        pick = self.rng.random()
        if pick < 0.12:
            del lines[at]
        elif pick < 0.20:
            lines.insert(at, lines[self.rng.randrange(len(lines))])
        elif pick < 0.28:
            other = self.rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        elif pick < 0.33:
            lines = lines[:at]
        elif pick < 0.85:
            fields = re.split(f"({separators})", lines[at])
            spots = [i for i in range(0, len(fields), 2) if fields[i]]
            if spots:
                spot = self.rng.choice(spots)
                fields[spot] = self.value(fields[spot])
            lines[at] = "".join(fields)
        else:
            return self.bytes("\n".join(lines).encode("utf-8", "replace")).decode("utf-8", "replace")
        return "\n".join(lines)

    def bytes(self, content):
        content = bytearray(content)
        for _ in range(self.rng.choice([1, 1, 2, 8])):
            pick = self.rng.random()
            at = self.rng.randrange(len(content)) if content else 0
            if pick < 0.5 and content:
                content[at] = self.rng.randrange(256)
            elif pick < 0.65:
                content[at:at] = bytes(self.rng.randrange(256) for _ in range(self.rng.choice([1, 4, 64])))
            elif pick < 0.8 and content:
                del content[at:at + self.rng.choice([1, 8, 512])]
            elif pick < 0.9:
                content = content[:at]
            else:
                content[0:0] = self.rng.choice([b"\xef\xbb\xbf", b"\xff\xfe", b"\x00", b"\n" * 100])
        return bytes(content)

    def hdf5(self, content):
        """Bytes, or a number with its checksum made good."""
        arrays, singles = hdf5_bytes.chunks(content), hdf5_bytes.single_numbers(content)
        pick = self.rng.random()
        if pick < 0.2 or not arrays:
            return self.bytes(content)
        real = struct.pack("<d", self.rng.choice([math.nan, math.inf, -math.inf, 0.0, -1.0, 1e300, 1e-300, 1e9, -1e9, 0.5, 2.0]))
        whole = self.rng.choice([0, -1, 1, 2**31 - 1, -2**31, 10**6, 77])
        if pick < 0.35 and singles:
            at = self.rng.choice(singles)
            packed = real if self.rng.random() < 0.5 else struct.pack("<q", self.rng.choice([whole, 2**62, -2**63]))
            return content[:at] + packed + content[at + 8:]
        packed = real if self.rng.random() < 0.6 else struct.pack(self.rng.choice(["<i", "<q"]), whole)
        fitting = [chunk for chunk in arrays if chunk[1] >= len(packed)]
        if not fitting:
            return self.bytes(content)
        chunk = self.rng.choice(fitting)
        return hdf5_bytes.write_number(content, chunk, self.rng.randrange(chunk[1] // len(packed)), packed)

    def scene(self, text):
        """One change of a parameter file: mostly of a value, sometimes of its form."""
        lines = text.split("\n")
        values = [i for i, line in enumerate(lines) if "=" in line]
        if not values:
            return self.lines(text)
        pick = self.rng.random()
        if pick < 0.6:
            at = self.rng.choice(values)
            key, value = lines[at].split("=", 1)
            lines[at] = f"{key}= {self.value(value.strip())}"
        elif pick < 0.7:
            at, other = self.rng.choice(values), self.rng.choice(values)
            lines[at] = lines[at].split("=")[0] + "=" + lines[other].split("=")[1]
        elif pick < 0.75:
            depth = self.rng.choice([33, 2000, 20000])
            lines[0:0] = ["subsection a"] * depth + ["end"] * depth
        elif pick < 0.78:
            at = self.rng.choice(values)
            lines[at] = lines[at].swapcase()
        else:
            return self.lines(text)
        return "\n".join(lines)


def as_json(text):
    """A parameter file as nested objects; one that is no longer well-formed stays text."""
    root, stack = {}, []
    stack.append(root)
    text = text.replace("\\\n", " ")
    for line in text.split("\n"):
        line = line.split("#")[0].strip()
        if line.startswith("subsection "):
            stack.append(stack[-1].setdefault(line[11:].strip(), {}))
        elif line == "end":
            stack.pop()
        elif line.startswith("set ") and "=" in line:
            key, value = line[4:].split("=", 1)
            stack[-1][key.strip()] = value.strip()
    return root


def unquoted_numbers(rng, node):
    for key, value in list(node.items()):
        if isinstance(value, dict):
            unquoted_numbers(rng, value)
        elif rng.random() < 0.5:
            try:
                node[key] = float(value)
            except ValueError:
                pass


def json_scene(mutator, text):
    rng = mutator.rng
    root = as_json(text)
    unquoted_numbers(rng, root)
    pick = rng.random()
    if pick < 0.5:
        node = root
        while True:
            key = rng.choice(list(node))
            if isinstance(node[key], dict) and node[key]:
                node = node[key]
                continue
            node[key] = rng.choice([mutator.value(str(node[key])), None, True, [1, 2], {}, 1e308, -1, 10**30, {"a": {}}])
            break
    content = json.dumps(root, indent=1) if rng.random() < 0.9 else "[" * rng.choice([10, 100000])
    if 0.5 <= pick < 0.6:
        depth = rng.choice([40, 3000, 100000])
        return '{"a":' * depth + content + "}" * depth
    return mutator.lines(content) if pick >= 0.6 else content


class Trial:
    """One mutation: files in a folder of its own, and the commands to run there."""

    def __init__(self, number, rng, folder, prepared):
        self.number, self.rng, self.folder, self.prepared = number, rng, folder, prepared
        self.mutate = Mutator(rng)
        self.commands = []
        for name, content in seeds.FILES.items():
            self.write(name, content)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))

    def times(self, change, content):
        for _ in range(self.rng.choice([1, 1, 1, 2, 3])):
            content = change(content)
        return content

    def command(self, *words):
        self.commands.append([str(word).replace("\x00", "?") for word in words])

    def scene_file(self, name, verbs=("check", "run")):
        verb = self.rng.choice(verbs)
        self.command(verb, name, *(["-o", "out"] if verb == "run" else []))

    # --- kinds of mutation ---

    def scene(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.prm", self.times(self.mutate.scene, text))
        self.scene_file("scene.prm")

    def scene_in_json(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.json", json_scene(self.mutate, text))
        self.scene_file("scene.json")

    def override(self):
        text = seeds.SCENES[self.rng.choice(list(seeds.SCENES))]
        self.write("scene.prm", text)
        keys, path = [], []
        for line in text.split("\n"):
            line = line.split("#")[0].strip()
            if line.startswith("subsection "):
                path.append(line[11:])
            elif line == "end":
                path.pop()
            elif line.startswith("set "):
                key, value = line[4:].split("=", 1)
                keys.append(("/".join(path + [key.strip()]), value.strip()))
        words = []
        for key, value in self.rng.sample(keys, self.rng.choice([1, 1, 2])):
            words += ["-s", f"{key}={self.mutate.value(value)}"]
        verb = self.rng.choice(["check", "run"])
        self.command(verb, "scene.prm", *words, *(["-o", "out"] if verb == "run" else []))

    def use_packing(self, name, periodic):
        pick = self.rng.random()
        if pick < 0.3 or (periodic and pick < 0.5):
            self.command("homogenise", name, "--interaction-ratio", self.rng.choice(["1.5", "1.4", "1", "2.5"]),
                         "--normal-modulus", "25e9", "--shear-ratio", "0.2", "--solver",
                         self.rng.choice(["automatic", "iterative", "direct"]), "-o", "out")
        elif pick < 0.6:
            self.command("pack", "--from", name, "--box", "0.012,0.012,0.012", "-o",
                         self.rng.choice(["new.txt", "new.h5", "new.csv"]))
        else:
            kind = self.rng.choice(["cell", "homogenisation"] if periodic else ["uniaxial", "quasi_static"])
            text = seeds.SCENES[kind].replace("cell.txt" if periodic else "packing.txt", name)
            self.write("scene.prm", text)
            self.scene_file("scene.prm")

    def packing_text(self):
        periodic = self.rng.random() < 0.5
        source = "cell.txt" if periodic else "packing.txt"
        self.write("p.txt", self.times(self.mutate.lines, seeds.FILES[source]))
        self.use_packing("p.txt", periodic)

    def packing_hdf5(self):
        periodic = self.rng.random() < 0.5
        self.write("p.h5", self.times(self.mutate.hdf5, self.prepared["cell.h5" if periodic else "packing.h5"]))
        self.use_packing("p.h5", periodic)

    def mesh(self):
        name = self.rng.choice(["two.msh", "two4.msh"])
        self.write("two.msh", self.times(self.mutate.lines, seeds.FILES[name]))
        self.write("scene.prm", seeds.CONTINUUM_STATIC)
        self.scene_file("scene.prm")

    def path(self):
        link = self.rng.random() < 0.5
        text = seeds.LINK_PATH if link else seeds.POINT_PATH
        constants = list(seeds.LINK_CONSTANTS if link else seeds.POINT_CONSTANTS)
        if self.rng.random() < 0.7:
            text = self.times(self.mutate.lines, text)
        else:
            at = self.rng.randrange(len(constants))
            key, value = constants[at].split("=")
            constants[at] = f"{key}={self.mutate.value(value)}"
        self.write("path.csv", text)
        words = [word for constant in constants for word in ("-s", constant)]
        if link:
            self.command("link-test", "--law", self.rng.choice(["CPM", "cpm"]), *words, "--path", "path.csv")
        else:
            self.command("point-test", "--material", "damage-plastic concrete", *words, "--path", "path.csv")

    def state(self):
        self.write("state.h5", self.times(self.mutate.hdf5, self.prepared["state.h5"]))
        text = seeds.SEQUENTIAL.replace("  set Source = uniaxial\n", "  set Source = file\n  set Files = state.h5\n", 1)
        self.write("scene.prm", text)
        self.command(self.rng.choice(["transfer", "run"]), "scene.prm", "-o", "out")

    def checkpoint(self):
        kind = self.rng.choice(sorted(self.prepared["interrupted"]))
        files = dict(self.prepared["interrupted"][kind])
        mine = [name for name in files if name.endswith("checkpoint.h5")]
        if self.rng.random() < 0.7:
            files[mine[0]] = self.times(self.mutate.hdf5, files[mine[0]])
        else:
            name = self.rng.choice(sorted(set(files) - set(mine)))
            if self.rng.random() < 0.3:
                del files[name]
            elif name.endswith(".h5"):
                files[name] = self.mutate.hdf5(files[name])
            else:
                files[name] = self.mutate.bytes(files[name])
        for name, content in files.items():
            self.write(name, content)
        self.write("scene.prm", seeds.SCENES[kind])
        self.command("run", "scene.prm", "-o", "out", "--resume", *self.prepared["slow"][kind])

    def command_line(self):
        number = self.mutate.number
        words = [
            ["pack", "--radius", number("1e-3"), "--count", self.rng.choice(["20", number("20")]), "-o", "new.txt"],
            ["pack", "--radius", "1e-3", "--count", "20", "--seed", number("1"), "-o", "new.txt"],
            ["pack", "--radius", "1e-3", "--count", "20", "--friction", number("1"), "--damping", self.rng.choice(
                ["0.6", number("0.6")]), "-o", "new.txt"],
            ["pack", "--from", "cell.txt", "--box", ",".join(number("0.01") for _ in range(3)), "-o", "new.txt"],
            ["homogenise", "cell.txt", "--interaction-ratio", number("1.5"), "--normal-modulus", number("25e9"),
             "--shear-ratio", number("0.2"), "-o", "out"],
            ["homogenise", "cell.txt", "--interaction-ratio", "1.5", "--normal-modulus", "25e9", "--shear-ratio", "0.2",
             "--tolerance", number("1e-10"), "--thickness", number("1")],
            ["envelope", "-s", "Element size=" + number("1"), "-s", "Compressive strength=" + number("30e6")],
            [self.rng.choice(["run", "check", "describe", "transfer", "pack"]), self.rng.choice(NASTY_WORDS)],
        ]
        self.command(*self.rng.choice(words))

    KINDS = (("scene", 5), ("scene_in_json", 2), ("override", 3), ("packing_text", 3), ("packing_hdf5", 2), ("mesh", 3),
             ("path", 3), ("state", 2), ("checkpoint", 3), ("command_line", 2))

    def draw(self):
        names, weights = zip(*self.KINDS)
        self.kind = self.rng.choices(names, weights)[0]
        getattr(self, self.kind)()


class Answer:
    """How the program ended and what it said."""

    def __init__(self, program, words, folder):
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        out, err = folder / "stdout.log", folder / "stderr.log"

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # ignored where this script runs in the background

        started = time.monotonic()
        self.hung = self.stopped = False
        with out.open("wb") as to_out, err.open("wb") as to_err:
            process = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=to_out, stderr=to_err,
                                       env=environment, preexec_fn=limit)
            try:
                self.status = process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.stopped = True
                process.send_signal(signal.SIGINT)
                try:
                    self.status = process.wait(LEAVE)
                except subprocess.TimeoutExpired:
                    self.hung = True
                    process.kill()
                    self.status = process.wait()
        self.seconds = time.monotonic() - started
        self.out, self.err = (path.read_bytes().decode("utf-8", "replace") for path in (out, err))


NO_NUMBER = re.compile(r"(?<![\w/.-])[-+]?(nan|inf|infinity)(?![\w/])", re.IGNORECASE)


def figures_without_value(node, path=""):
    """Names of figures that are null, zero (moduli and strengths) or not finite in a summary, unless it says why."""
    if isinstance(node, dict):
        unit, value = node.get("unit"), node.get("value")
        if "value" in node and "unit" in node:
            explained = any(isinstance(v, str) and v and k != "unit" for k, v in node.items())
            if (value is None or (unit == "Pa" and value == 0)) and not explained:
                yield path
        for key, child in node.items():
            yield from figures_without_value(child, f"{path}/{key}")
    elif isinstance(node, list):
        for n, child in enumerate(node):
            yield from figures_without_value(child, f"{path}/{n}")


def asked_for(table):
    """A table without the column that compares with a run of all particles, which these scenes do not ask for."""
    lines = [line.split(",") for line in table.split("\n")]
    left_out = [at for at, name in enumerate(lines[0]) if name.startswith("error_against_all_particles")]
    return "\n".join(",".join(field for at, field in enumerate(line) if at not in left_out) for line in lines)


def complaint_about_results(trial, answer):
    """What is wrong with results that were called a success; "" if nothing."""
    if found := NO_NUMBER.search(answer.out):
        return f"status 0 and \"{found.group()}\" among the results"
    for file in sorted((trial.folder / "out").rglob("*.csv")):
        if found := NO_NUMBER.search(asked_for(file.read_text("utf-8", "replace"))):
            return f"status 0 and \"{found.group()}\" in {file.name}"
    summary = trial.folder / "out" / "summary.json"
    if summary.exists():
        for name in figures_without_value(json.loads(summary.read_text()).get("figures", {})):
            return f"status 0 and no value of {name}"
    return ""


def complaint(trial, answer, words):
    """What is wrong with an answer; "" if nothing."""
    if answer.hung:
        return f"hangs: no end {LEAVE} s after an interrupt"
    if answer.stopped and answer.status == -signal.SIGINT:
        return ""  # a command that leaves nothing behind need not catch it
    if answer.status < 0:
        return f"ended by signal {-answer.status}"
    if "mistake in the program" in answer.err or "terminate called" in answer.err or "Assertion" in answer.err:
        return "a mistake in the program"
    if answer.status not in (SUCCESS, FAILURE, BAD_INPUT, INTERRUPTED):
        return f"status {answer.status}"
    if answer.status in (FAILURE, BAD_INPUT) and "breccia" not in answer.err:
        return f"status {answer.status} without a message"
    if answer.status == INTERRUPTED and not answer.stopped:
        return "says that it was interrupted, and was not"
    if answer.status == BAD_INPUT and "--resume" not in words and (trial.folder / "out" / "summary.json").exists():
        return "status 2 and results"
    return complaint_about_results(trial, answer) if answer.status == SUCCESS else ""


def prepare(program, folder):
    """Sound binary inputs, made by the program itself: packings, a state, interrupted runs."""

    def run(*words, name=None, stop_at=None):
        place = folder / (name or "made")
        place.mkdir(exist_ok=True)
        for file, content in {**seeds.FILES, **{f"{k}.prm": v for k, v in seeds.SCENES.items()}}.items():
            (place / file).write_text(content)
        process = subprocess.Popen([program, *words], cwd=place, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   env=dict(os.environ, OMP_NUM_THREADS="1"),
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        while stop_at and process.poll() is None and not (place / stop_at).exists():
            time.sleep(0.002)
        if stop_at:
            process.send_signal(signal.SIGINT)
        message = process.communicate()[1].decode("utf-8", "replace")
        if process.returncode != (INTERRUPTED if stop_at else SUCCESS):
            sys.exit(f"fuzz: breccia {' '.join(words)}: status {process.returncode}\n{message}")
        return place

    made = run("pack", "--from", "cell.txt", "-o", "cell.h5")
    run("pack", "--from", "packing.txt", "-o", "packing.h5")
    run("transfer", "sequential.prm", "-o", "transfer")
    prepared = {"cell.h5": (made / "cell.h5").read_bytes(), "packing.h5": (made / "packing.h5").read_bytes(),
                "state.h5": (made / "transfer/states/state_001.h5").read_bytes(), "interrupted": {}}
    # Slow enough to be caught under way, and to have saved a state.
    often = ["-s", "Output/Checkpoint interval=1e-3"]
    prepared["slow"] = {"uniaxial": often + ["-s", "Loading/Tension/Strain rate=0.5"],
                        "cell": often + ["-s", "Loading/Leg 2/Duration=5e-2"],
                        "continuum_static": often + ["-s", "Control/First step=1e-3"],
                        "quasi_static": often + ["-s", "Loading/Tension/Strain step=1e-7"]}
    for kind, words in prepared["slow"].items():
        place = run("run", f"{kind}.prm", "-o", "out", *words, name=f"interrupted_{kind}", stop_at="out/running/checkpoint.h5")
        prepared["interrupted"][kind] = {str(file.relative_to(place)): file.read_bytes()
                                         for file in sorted((place / "out").rglob("*")) if file.is_file()}
    return prepared


def attempt(program, seed, number, prepared, keep):
    """@return kind, status, complaint or "", and the command"""
    folder = Path(keep) if keep else Path(tempfile.mkdtemp(prefix="fuzz_"))
    try:
        if keep:
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        trial = Trial(number, random.Random(f"{seed}/{number}"), folder, prepared)
        trial.draw()
        for words in trial.commands:
            answer = Answer(program, words, folder)
            wrong = complaint(trial, answer, words)
            told = answer.err.strip().replace("\n", " | ")[-300:]
            return trial.kind, answer, wrong, " ".join(words), told
    finally:
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mutations", type=int, default=300)
    parser.add_argument("--only", type=int, help="do this mutation alone")
    parser.add_argument("--keep", help="folder in which to leave the files of --only")
    parser.add_argument("--kind", help="leave out all other kinds of mutation")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    if options.kind:
        Trial.KINDS = tuple(kind for kind in Trial.KINDS if kind[0] == options.kind)
    numbers = [options.only] if options.only is not None else range(options.mutations)
    statuses, failures, started = {}, 0, time.monotonic()
    with tempfile.TemporaryDirectory(prefix="fuzz_") as scratch:
        prepared = prepare(program, Path(scratch))
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            work = {number: pool.submit(attempt, program, options.seed, number, prepared,
                                        options.keep if options.only is not None else None) for number in numbers}
            for number, result in work.items():
                kind, answer, wrong, command, told = result.result()
                statuses[answer.status] = statuses.get(answer.status, 0) + 1
                if wrong or options.only is not None:
                    failures += 1 if wrong else 0
                    print(f"{'FAILED' if wrong else 'passed'} --seed {options.seed} --only {number} ({kind}, "
                          f"{answer.seconds:.1f} s, status {answer.status}): {wrong}\n    breccia {command}\n    {told}", flush=True)
    print(f"{len(numbers)} mutations of seed {options.seed} in {time.monotonic() - started:.0f} s; ends by status: "
          + ", ".join(f"{status}: {count}" for status, count in sorted(statuses.items())) + f"; {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
