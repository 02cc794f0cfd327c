#!/usr/bin/env bash
# installed.sh SOURCE BUILD SCRATCH: a program outside the source, built by find_package(Breccia) from what `cmake --install` leaves.
set -euo pipefail
source=$1 build=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --component development --prefix "$scratch/prefix" > "$scratch/install.log"
cp -r "$source/tests/foundation/own_program" "$scratch/program"
cmake -S "$scratch/program" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release \
  > "$scratch/configure.log"
cmake --build "$scratch/build" > "$scratch/build.log" || { cat "$scratch/build.log"; exit 1; }
"$scratch/build/pull_a_bond"
if [ -x "$scratch/build/throw_a_ball" ]; then
  "$scratch/build/throw_a_ball"
fi
if [ -x "$scratch/build/run_a_scene" ]; then
  "$scratch/build/run_a_scene" "$source/apps/scenes/bouncing_sphere.prm" blow/largest
fi
# Nothing of the installation may point back to where it was built.
if grep -rIl --include='*.cmake' -e "$source" -e "$build" "$scratch/prefix"; then
  echo "the files above name the folders of the build"
  exit 1
fi
rm -rf "$scratch"
