#!/usr/bin/env bash
# No call is left in the loops over links and particles: reads the object code of the kernels.
#
#   hot_loops.sh OBJDUMP OBJECT...
#
# A kernel is one straight line of arithmetic on registers. Where the compiler stops inlining half-way it passes packs through memory,
# at a fraction of the speed, and nothing else shows it. What may be called: branches that are kept out of the line on purpose
# (BRECCIA_BRANCH, BRECCIA_RARE), fma and what stands for it on processors without the instruction, and outside the loops the runtime of
# OpenMP, what sets sums to zero, and memory that a pass takes before it begins.
set -euo pipefail

objdump=$1
shift
kernels='(link_update::update_block<|dem::.*particle_pass<|FrictionalAssembly::block_|IncompleteFactor<.*>::(eliminate|apply<)|SplineGrid::spread_part<|BondForces::Pass::run_as<|StiffnessOperator::(apply|gather<))'
allowed='replace_large_rotations<|multiply_add_in_parts<|::damage_at<|advance_elements<|exact_rotation_coefficients|solve_rate_equation<|^(sin|cos|sincos|fma)(@|-|\+|$)|omp_get_|GOMP_|__kmpc_|^memset|__stack_chk_fail|update_block<|StiffnessOperator::gather<'
allowed+='|^memmove|_default_append|emplace_back|_Vector_base<|_Unwind_Resume|^[.]text[.]unlikely'

# A call of a function that is local to its object is given as a place in its section: four bytes before its first one.
"$objdump" --disassemble --reloc --demangle --no-show-raw-insn "$@" | awk -v kernels="$kernels" -v allowed="$allowed" '
  function number(hex,   n, i) { for (i = 1; i <= length(hex); ++i) n = 16 * n + index("0123456789abcdef", substr(hex, i, 1)) - 1; return n }
  function place(text,   sign) {
    sub(/^[.]text/, "", text)
    sign = substr(text, 1, 1) == "-" ? -1 : 1
    sub(/^[-+]0x/, "", text)
    return sign * number(text) + 4
  }
  function check(kernel, target) { if (target !~ allowed) { printf "%s\n  calls %s\n", kernel, target; bad = 1 } }
  function resolve(   k) {
    for (k = 1; k <= waiting; ++k) check(caller[k], at_place[local_place[k]])
    waiting = 0
    split("", at_place)
  }
  /file format/ { resolve() }
  /^Disassembly of section/ { section = $4 }
  /^[0-9a-f]+ <.*>:$/ {
    name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/>:$/, "", name)
    if (section == ".text:") at_place[number($1)] = name
    inside = name ~ kernels; found += inside; next
  }
  inside && called && /R_(X86_64|AARCH64)_/ {
    target = $0; sub(/^.*R_[A-Z0-9_]+[ \t]+/, "", target); called = 0
    if (target ~ /^[.]text[-+]0x[0-9a-f]+$/) { caller[++waiting] = name; local_place[waiting] = place(target) }
    else check(name, target)
    next
  }
  inside { called = /[ \t](call|callq|bl)[ \t]/ }
  END {
    resolve()
    if (!found) { print "no kernel found in the objects"; exit 2 }
    printf "%d kernels\n", found
    exit bad
  }'
