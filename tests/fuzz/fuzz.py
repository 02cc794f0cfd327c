#!/usr/bin/env python3
"""Gives the program damaged and senseless input of every kind, and holds it to its word: whatever is typed, it answers with a
result or with a message.

Nothing may end by a signal, a hang, "internal error", or with status 0 and nan, inf or nothing where a figure was requested
for. Every mutation follows from the seed and its number alone, so that what was found can be done again:

    fuzz.py build/release/apps/breccia --seed 7 --mutations 1000
    fuzz.py build/release/apps/breccia --seed 7 --only 123 --keep case
"""

import argparse
import concurrent.futures
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import answers
import seeds
import trials


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
        if process.returncode != (answers.INTERRUPTED if stop_at else answers.SUCCESS):
            sys.exit(f"fuzz: breccia {' '.join(words)}: status {process.returncode}\n{message}")
        return place

    made = run("pack", "--from", "cell.txt", "-o", "cell.h5")
    run("pack", "--from", "packing.txt", "-o", "packing.h5")
    as_text = {}
    for name in ("cell", "packing"):
        shutil.copyfile(made / f"{name}.h5", made / "p.h5")
        run("pack", "--from", "p.h5", "-o", "new.txt")
        as_text[f"{name} as text"] = (made / "new.txt").read_text()
    run("transfer", "sequential.prm", "-o", "transfer")
    prepared = {"cell.h5": (made / "cell.h5").read_bytes(), "packing.h5": (made / "packing.h5").read_bytes(),
                "state.h5": (made / "transfer/states/state_001.h5").read_bytes(), "interrupted": {}, **as_text}
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
        trial = trials.Trial(number, random.Random(f"{seed}/{number}"), folder, prepared)
        trial.draw()
        for words in trial.commands:
            answer = answers.Answer(program, words, folder)
            wrong = answers.complaint(trial, answer, words)
            said = answer.err.strip().replace("\n", " | ")[-300:]
            return trial.kind, answer, wrong, " ".join(words), said
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
        trials.Trial.KINDS = tuple(kind for kind in trials.Trial.KINDS if kind[0] == options.kind)
    numbers = [options.only] if options.only is not None else range(options.mutations)
    statuses, failures, started = {}, 0, time.monotonic()
    with tempfile.TemporaryDirectory(prefix="fuzz_") as scratch:
        prepared = prepare(program, Path(scratch))
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            work = {number: pool.submit(attempt, program, options.seed, number, prepared,
                                        options.keep if options.only is not None else None) for number in numbers}
            for number, result in work.items():
                kind, answer, wrong, command, said = result.result()
                statuses[answer.status] = statuses.get(answer.status, 0) + 1
                if wrong or options.only is not None:
                    failures += 1 if wrong else 0
                    print(f"{'FAILED' if wrong else 'passed'} --seed {options.seed} --only {number} ({kind}, "
                          f"{answer.seconds:.1f} s, status {answer.status}): {wrong}\n    breccia {command}\n    {said}", flush=True)
    print(f"{len(numbers)} mutations of seed {options.seed} in {time.monotonic() - started:.0f} s; ends by status: "
          + ", ".join(f"{status}: {count}" for status, count in sorted(statuses.items())) + f"; {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
