#!/usr/bin/env bash
# No call is left in the loops over links and particles: reads the object code of the kernels.
#
#   hot_loops.sh OBJDUMP OBJECT...
#
# A kernel is one straight line of arithmetic on registers. Where the compiler stops inlining half-way it passes packs through memory,
# at a fraction of the speed, and nothing else tells of it. What may be called: branches that are kept out of the line on purpose
# (BRECCIA_BRANCH, BRECCIA_RARE), and the runtime of OpenMP outside the loops.
set -euo pipefail

objdump=$1
shift
kernels='(link_update::update_block<|dem::.*particle_pass<|FrictionalAssembly::block_)'
allowed='replace_large_rotations<|::damage_at<|advance_elements<|exact_rotation_coefficients|^(sin|cos|sincos)(@|-|\+|$)|omp_get_|GOMP_|__stack_chk_fail|update_block<'

"$objdump" --disassemble --reloc --demangle --no-show-raw-insn "$@" | awk -v kernels="$kernels" -v allowed="$allowed" '
  /^[0-9a-f]+ <.*>:$/ { name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/>:$/, "", name); inside = name ~ kernels; found += inside; next }
  inside && /R_(X86_64|AARCH64)_/ && called { target = $0; sub(/^.*R_[A-Z0-9_]+[ \t]+/, "", target); check() }
  inside { called = / (call|callq|bl)[ \t]/ }
  function check() {
    called = 0
    if (target !~ allowed) { printf "%s\n  calls %s\n", name, target; bad = 1 }
  }
  END {
    if (!found) { print "no kernel found in the objects"; exit 2 }
    printf "%d kernels\n", found
    exit bad
  }'
