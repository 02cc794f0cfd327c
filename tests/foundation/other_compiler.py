"""Checks that the sources of dem are well-formed for another compiler than the one that builds them.

  other_compiler.py BUILD COMPILER

Parses and instantiates, by the flags in BUILD/compile_commands.json, without making code: some words that one compiler takes are an error
for the next (a structured binding that an OpenMP region reads, for Clang 14). Exit status 1 where a source is refused, 77 where the compiler does
not know the processor's flags.
"""
import json
import pathlib
import shlex
import subprocess
import sys

build, compiler = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]


def arguments(command):
    """Of the compilation, without its output, its warnings and headers that are parsed already."""
    words = iter(shlex.split(command)[1:])
    kept = []
    for word in words:
        if word in ("-o", "-include", "-MF", "-MT"):
            next(words)
        elif not word.startswith("-W") and word not in ("-c", "-MD", "-fno-semantic-interposition"):
            kept.append(word)
    return kept


commands = json.loads((build / "compile_commands.json").read_text())
sources = [c for c in commands if "/dem.dir/" in c["command"] and not c["file"].endswith("cmake_pch.hxx.cxx")]
assert len(sources) > 10, "no sources of dem in compile_commands.json"

flags = [word for word in arguments(sources[0]["command"]) if word.startswith("-m") or word == "-fopenmp"]
trial = subprocess.run([compiler, *flags, "-fsyntax-only", "-x", "c++", "-"], input="#include <omp.h>\n", text=True, capture_output=True)
if trial.returncode:
    print(trial.stderr)
    sys.exit(77)

refused = 0
for source in sources:
    call = [compiler, *arguments(source["command"]), "-fsyntax-only", "-w", "-ferror-limit=3"]
    done = subprocess.run(call, cwd=source["directory"], capture_output=True, text=True)
    if done.returncode:
        refused += 1
        print(f"{source['file']}:\n{done.stderr}")
print(f"{len(sources)} sources, {refused} refused")
sys.exit(1 if refused else 0)
