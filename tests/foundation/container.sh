#!/usr/bin/env bash
# container.sh SOURCE BUILD SCRATCH: the container of an existing build's package is made, and the program in it runs a scene.
# Leaves with status 77, which the tests count as skipped, where neither podman nor docker is there, or Debian's image cannot be had.
set -euo pipefail
source=$1 build=$2 scratch=$3
tool=$(command -v podman || command -v docker || true)
if [ -z "$tool" ]; then
  echo "skipped: neither podman nor docker is here"
  exit 77
fi
base=$(awk '$1 == "FROM" { print $2 }' "$source/container/Containerfile")
if ! "$tool" pull --quiet "$base"; then
  echo "skipped: $base cannot be had"
  exit 77
fi
rm -rf "$scratch"
mkdir -p "$scratch/packages" "$scratch/scenes"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/packages" > "$scratch/cpack.log" || { cat "$scratch/cpack.log"; exit 1; }
image=breccia-test-$$
"$tool" build --quiet -t "$image" -f "$source/container/Containerfile" "$scratch/packages"
trap '"$tool" rmi --force "$image" > /dev/null' EXIT
"$tool" run --rm "$image" --version
cp "$source/apps/scenes/bouncing_sphere.prm" "$scratch/scenes"
"$tool" run --rm -v "$scratch/scenes:/scenes" "$image" run bouncing_sphere.prm -o out
test -s "$scratch/scenes/out/summary.json"
test -s "$scratch/scenes/out/curve.png"
rm -rf "$scratch"
