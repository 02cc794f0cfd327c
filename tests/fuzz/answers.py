"""How the program ended, what it said and left, and what is wrong with that."""

import json
import os
import re
import resource
import signal
import subprocess
import time

PATIENCE = 30  # s: then it is requested to stop
LEAVE = 60  # s to answer that, on a machine that is busy
MEMORY = 6 << 30  # bytes of address space: a model beyond must say so
SUCCESS, FAILURE, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130


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


# A range that ends with "or inf", as describe has it, is no result.
NO_NUMBER = re.compile(r"(?<![\w/.-])(?<!, or )[-+]?(nan|inf|infinity)(?![\w/])", re.IGNORECASE)


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


def requested_part(table):
    """A table without the column that compares with a run of all particles, which these scenes do not request."""
    lines = [line.split(",") for line in table.split("\n")]
    left_out = [at for at, name in enumerate(lines[0]) if name.startswith("error_against_all_particles")]
    return "\n".join(",".join(field for at, field in enumerate(line) if at not in left_out) for line in lines)


def complaint_about_results(trial, answer):
    """What is wrong with results that were called a success; "" if nothing."""
    if found := NO_NUMBER.search(answer.out):
        return f"status 0 and \"{found.group()}\" among the results"
    for file in sorted((trial.folder / "out").rglob("*.csv")):
        if found := NO_NUMBER.search(requested_part(file.read_text("utf-8", "replace"))):
            return f"status 0 and \"{found.group()}\" in {file.name}"
    if trial.expected and (trial.folder / trial.expected[0]).read_text("utf-8", "replace") != trial.expected[1]:
        return f"status 0 and a {trial.expected[0]} that is not what the undamaged file gives"
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
    if "internal error" in answer.err or "terminate called" in answer.err or "Assertion" in answer.err:
        return "an internal error"
    if answer.status not in (SUCCESS, FAILURE, BAD_INPUT, INTERRUPTED):
        return f"status {answer.status}"
    if answer.status in (FAILURE, BAD_INPUT) and "breccia" not in answer.err:
        return f"status {answer.status} without a message"
    if answer.status == INTERRUPTED and not answer.stopped:
        return "says that it was interrupted, and was not"
    if answer.status == BAD_INPUT and "--resume" not in words and (trial.folder / "out" / "summary.json").exists():
        return "status 2 and results"
    return complaint_about_results(trial, answer) if answer.status == SUCCESS else ""
