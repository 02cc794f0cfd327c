#!/usr/bin/env bash
# A program of several levels of x86-64 (cmake/BrecciaLevels.cmake) loads the kernels of the level that it is allowed, and all give the
# committed bits.
#
#   levels.sh PROGRAM        that checks the bits: test_fingerprints
set -euo pipefail

program=$1
loader=$(readelf --program-headers "$program" | sed -n 's/.*program interpreter: \(.*\)]/\1/p')
known=$("$loader" --help)

run=0
for level in v4 v3 v2; do
  if [[ $level != v2 && ! $known =~ x86-64-$level\ \(supported ]]; then
    printf 'x86-64-%s: not on this processor\n' "$level"
    continue
  fi
  library=$("$loader" --glibc-hwcaps-mask "x86-64-$level" --list "$program" | sed -n 's/.*libbreccia_dem\.so => \([^ ]*\).*/\1/p')
  case $level in
    v2) [[ -n $library && $library != */glibc-hwcaps/* ]] ;;
    *) [[ $library == */glibc-hwcaps/x86-64-$level/* ]] ;;
  esac || { printf 'x86-64-%s: takes %s\n' "$level" "$library"; exit 1; }
  "$loader" --glibc-hwcaps-mask "x86-64-$level" "$program" || { printf 'x86-64-%s: other bits\n' "$level"; exit 1; }
  run=$((run + 1))
done

# Without a mask: the best.
[[ $("$loader" --list "$program") == *$([[ $known =~ x86-64-v4\ \(supported ]] && echo x86-64-v4 || echo libbreccia_dem.so)* ]]
printf '%d levels\n' "$run"
