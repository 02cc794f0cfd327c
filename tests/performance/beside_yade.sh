#!/usr/bin/env bash
# Elastic links of the CPM law on one packing, on one thread: bench_kernel and YADE by turns, so that both see the same machine.
#
#   beside_yade.sh BENCH_KERNEL [PARTICLES [ROUNDS]]      default 20000 and 5; wants `yade` (Debian: apt-get install yade)
#
# Prints links and M link updates per second of processor time of both in each round, and the median of their ratios.
set -euo pipefail

bench=$1 particles=${2:-20000} rounds=${3:-5}
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export OMP_NUM_THREADS=1

printf '%s\n' 'links  bench_kernel M/s  links of YADE  YADE M/s  ratio'
for ((round = 0; round < rounds; ++round)); do
  own=$("$bench" --elastic "$folder/packing.txt" "$particles")
  # YADE has its notes on the same stream: the figures are its last line.
  other=$(yade -n -x -j1 "$here/yade_links.py" "$folder/packing.txt" 40 2>/dev/null | tail -n 1)
  awk '{ printf "%d  %.1f  %d  %.3f  %.1f\n", $1, 1e-6 * $2, $3, 1e-6 * $4, $2 / $4 }' <<<"$own $other"
done | tee "$folder/rounds"
sort -n -k5 "$folder/rounds" | awk '{ ratio[NR] = $5 } END { printf "median ratio %.1f\n", ratio[int((NR + 1) / 2)] }'
