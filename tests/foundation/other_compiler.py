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
import tempfile

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
all_of_dem = [c for c in commands if "/dem.dir/" in c["command"]]
sources = [c for c in all_of_dem if not c["file"].endswith("cmake_pch.hxx.cxx")]
assert len(sources) > 10, "no sources of dem in compile_commands.json"

flags = [word for word in arguments(sources[0]["command"]) if word.startswith("-m") or word == "-fopenmp"]
trial = subprocess.run([compiler, *flags, "-fsyntax-only", "-x", "c++", "-"], input="#include <omp.h>\n", text=True, capture_output=True)
if trial.returncode:
    print(trial.stderr)
    sys.exit(77)

folder = tempfile.TemporaryDirectory()
headers = pathlib.Path(folder.name) / "headers.h"  # of other packages, parsed once: a third of the time is theirs
headers.write_text("".join(pathlib.Path(c["file"]).with_suffix("").read_text() for c in all_of_dem if c not in sources))
parsed = [word for word in arguments(sources[0]["command"]) if word != sources[0]["file"]]
subprocess.run([compiler, *parsed, "-w", "-x", "c++-header", str(headers), "-o", f"{headers}.pch"], cwd=sources[0]["directory"], check=True)

refused = 0
for source in sources:
    call = [compiler, "-include-pch", f"{headers}.pch", *arguments(source["command"]), "-fsyntax-only", "-w", "-ferror-limit=3"]
    done = subprocess.run(call, cwd=source["directory"], capture_output=True, text=True)
    if done.returncode:
        refused += 1
        print(f"{source['file']}:\n{done.stderr}")
print(f"{len(sources)} sources, {refused} refused")
sys.exit(1 if refused else 0)
