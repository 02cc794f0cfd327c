#!/usr/bin/env bash
# Behaviour of the launcher `breccia`, with its tools (apt-get, cmake, ninja, sudo, ctest, the program itself) replaced
# by stand-ins that note how they were called. Nothing is installed or compiled.
#
#   launcher_test.sh LAUNCHER SCRATCH
# shellcheck disable=SC2016 # the stand-ins expand their own variables
set -euo pipefail
unset DEBIAN_FRONTEND CMAKE_PREFIX_PATH DEAL_II_DIR

launcher=$1
scratch=$2/launcher
house="$scratch/a house" # with a space, on purpose
bin=$scratch/bin
state=$scratch/state
failures=0

# ---------------------------------------------------------------------------------------------------------------------
# The stand-ins

stand_in() # NAME, script on standard input
{
  { printf '#!/bin/bash\nstate=%q\nhouse=%q\n' "$state" "$house" && cat; } >"$bin/$1"
  chmod +x "$bin/$1"
}

make_bin()
{
  local tool
  for tool in awk bash cat cksum cp dirname env find flock grep mkdir mv nproc readlink rm sleep tail tee timeout; do
    ln -s "$(command -v $tool)" "$bin/$tool"
  done
  stand_in id <<<'cat "$state/uid"'
  stand_in dpkg-query <<<'grep -qxF "${!#}" "$state/installed" && printf installed'
  stand_in sudo <<<'echo "sudo" >>"$state/calls"; exec "$@"'
  stand_in apt-get <<'END'
words=() names=() skip=0
for word in "$@"; do
  if ((skip)); then skip=0; continue; fi
  case $word in
    -o) skip=1 ;;
    -q | -y | --no-install-recommends) ;;
    -s | install | update) words+=("$word") ;;
    *) names+=("$word") ;;
  esac
done
echo "apt-get ${words[*]}${names[*]:+ ${names[*]}}" >>"$state/calls"
[[ ${words[0]} == -s || ${DEBIAN_FRONTEND-} == noninteractive ]] || echo "interactive apt-get" >>"$state/calls"
case ${words[*]} in
  '-s install') [[ ! -e $state/no-lists ]] || { echo "E: Unable to locate package ${names[0]}"; exit 100; } ;;
  *) [[ ! -e $state/offline ]] || { echo "E: Failed to fetch http://mirror/x  Could not resolve"; exit 100; } ;;
esac
case ${words[*]} in
  update) rm -f "$state/no-lists" "$state/stale" ;;
  install)
    [[ ! -e $state/stale ]] || { echo "E: 404 Not Found"; exit 100; }
    printf '%s\n' "${names[@]}" >>"$state/installed" ;;
esac
END
  stand_in cmake <<<'echo "cmake $*" >>"$state/calls"; pwd >"$state/cmake-folder"'
  stand_in ninja <<'END'
echo "ninja ${!#}" >>"$state/calls"
mkdir "$state/building" || echo "two builds at once" >>"$state/calls"
sleep "$(cat "$state/build-seconds")"
rmdir "$state/building"
echo "[1/2] CXX dem/a.cc"
if [[ -e $state/broken ]]; then echo "dem/a.cc:3: error: expected ';'"; exit 1; fi
mkdir -p "$house/build/release/apps"
cp "$state/program" "$house/build/release/apps/breccia"
END
  ln -s "$(command -v rmdir)" "$bin/rmdir"
  stand_in ctest <<<'echo "ctest $*" >>"$state/calls"; pwd >"$state/ctest-folder"; exit 8'
}

# A new house with everything installed; each scenario starts from one.
new_house()
{
  rm -rf "$scratch"
  mkdir -p "$bin" "$state" "$house/dem" "$house/apps/scenes" "$house/tests"
  cp "$launcher" "$house/breccia"
  cat >"$house/packages.txt" <<'END'
# a comment
g++            command:bash            compiles
ninja-build    command:ninja           builds
fast-linker    command:no-such-linker? can be done without
nowhere-dev    header:nowhere/here.h   a library of this test
END
  touch "$house/CMakeLists.txt" "$house/dem/a.cc" "$house/apps/scenes/a.prm" "$house/tests/b.cc"
  make_bin
  printf '%s\n' g++ ninja-build fast-linker nowhere-dev >"$state/installed"
  echo 0 >"$state/uid"
  echo 0 >"$state/build-seconds"
  {
    printf '#!/bin/bash\n'
    printf 'printf "<%%s>" "$@"; echo; exit 7\n'
  } >"$state/program"
  chmod +x "$state/program"
  : >"$state/calls"
}

# start ARGUMENTS...: runs the launcher with the stand-ins; sets status, out, err, calls
start()
{
  : >"$state/calls"
  status=0
  PATH=$bin "${from:-$house/breccia}" "$@" >"$scratch/out" 2>"$scratch/err" || status=$?
  out=$(<"$scratch/out")
  err=$(<"$scratch/err")
  calls=$(<"$state/calls")
}

is() # WHAT FOUND EXPECTED
{
  [[ $2 == "$3" ]] && return
  printf 'FAILED %s: %s is\n%s\nexpected\n%s\nstandard error:\n%s\n\n' "$scenario" "$1" "$2" "$3" "$err"
  failures=$((failures + 1))
}

says() # TEXT: in the launcher's messages
{
  [[ $err == *"$1"* ]] || is "what it says" "$err" "... $1 ..."
}

full_set_up=$'cmake --preset release --fresh\nninja breccia'

# ---------------------------------------------------------------------------------------------------------------------
# Scenarios

scenario_first_start_configures_builds_and_hands_over()
{
  start run "a scene.prm" -s "A/B=c d"
  is calls "$calls" "$full_set_up"
  is output "$out" '<run><a scene.prm><-s><A/B=c d>'
  is status "$status" 7
  is "folder of cmake" "$(<"$state/cmake-folder")" "$house"
}

scenario_second_start_calls_no_tool()
{
  start run a.prm
  start run a.prm
  is calls "$calls" ""
  is messages "$err" ""
  is status "$status" 7
}

scenario_source_edit_rebuilds_and_scene_edit_does_not()
{
  start run a.prm
  sleep 0.02
  touch "$house/apps/scenes/a.prm" "$house/tests/b.cc"
  start run a.prm
  is "calls after a scene and a test were edited" "$calls" ""
  touch "$house/dem/a.cc"
  start run a.prm
  is "calls after a source was edited" "$calls" "ninja breccia"
}

scenario_edit_during_the_build_is_not_lost()
{
  echo 0.3 >"$state/build-seconds"
  (sleep 0.15 && touch "$house/dem/a.cc") &
  start run a.prm
  wait
  start run a.prm
  is calls "$calls" "ninja breccia"
}

scenario_moved_house_is_configured_anew()
{
  start run a.prm
  mv "$house" "$house moved"
  house="$house moved"
  rm -rf "$bin" && mkdir "$bin" && make_bin
  start run a.prm
  is calls "$calls" "$full_set_up"
}

scenario_link_and_other_folder_work()
{
  mkdir "$scratch/else where"
  ln -s "../a house/breccia" "$scratch/else where/b"
  cd "$scratch/else where"
  from=./b
  start describe
  is output "$out" '<describe>'
  from=
  cd /
}

scenario_help_needs_no_set_up()
{
  start
  is calls "$calls" ""
  is status "$status" 0
  [[ $out == *"./breccia run SCENE.prm"* ]] || is output "$out" help
}

scenario_missing_packages_are_installed()
{
  printf '%s\n' g++ fast-linker >"$state/installed"
  start run a.prm
  is calls "$calls" $'apt-get -s install ninja-build nowhere-dev\napt-get install ninja-build nowhere-dev\n'"$full_set_up"
}

scenario_doc_installs_its_own_packages_and_builds_the_site()
{
  mkdir -p "$house/doc/site"
  printf 'mkdocs command:mkdocs the site\n' >"$house/doc/site/packages.txt"
  stand_in mkdocs <<<'echo "mkdocs $*" >>"$state/calls"; pwd >"$state/site-folder"'
  start doc
  is calls "$calls" $'apt-get -s install mkdocs\napt-get install mkdocs\nmkdocs build --strict --quiet'
  is status "$status" 0
  is "folder of mkdocs" "$(<"$state/site-folder")" "$house"
  says "build/site/index.html"
  stand_in mkdocs <<<'exit 1'
  start doc
  is "status of a failure" "$status" 1
  says "could not be built"
  start doc now
  is "status of an argument" "$status" 2
  is "calls of an argument" "$calls" ""
}

scenario_empty_lists_are_updated_first()
{
  printf 'g++\n' >"$state/installed"
  touch "$state/no-lists"
  start run a.prm
  local names="ninja-build fast-linker nowhere-dev"
  is calls "$calls" $'apt-get -s install '"$names"$'\napt-get update\napt-get install '"$names"$'\n'"$full_set_up"
}

scenario_stale_lists_are_updated_and_tried_again()
{
  printf '%s\n' g++ ninja-build fast-linker >"$state/installed"
  touch "$state/stale"
  start run a.prm
  is calls "$calls" $'apt-get -s install nowhere-dev\napt-get install nowhere-dev\napt-get update
apt-get install nowhere-dev\n'"$full_set_up"
}

scenario_plain_user_goes_through_sudo()
{
  printf '%s\n' g++ ninja-build fast-linker >"$state/installed"
  echo 1000 >"$state/uid"
  start run a.prm
  is calls "$calls" $'apt-get -s install nowhere-dev\nsudo\napt-get install nowhere-dev\n'"$full_set_up"
}

scenario_plain_user_without_sudo_is_told_the_command()
{
  printf '%s\n' g++ ninja-build fast-linker >"$state/installed"
  echo 1000 >"$state/uid"
  rm "$bin/sudo"
  start run a.prm
  is status "$status" 2
  is calls "$calls" ""
  says "As root: apt-get install --no-install-recommends nowhere-dev"
}

scenario_failed_installation_is_one_clear_message()
{
  printf '%s\n' g++ ninja-build fast-linker >"$state/installed"
  touch "$state/offline"
  start run a.prm
  is status "$status" 2
  says "Failed to fetch"
  says "apt-get could not install the packages"
  [[ $calls != *cmake* ]] || is calls "$calls" "no build"
}

scenario_without_apt_names_are_listed()
{
  rm "$bin/apt-get" "$bin/dpkg-query" "$bin/ninja"
  start run a.prm
  is status "$status" 2
  is calls "$calls" ""
  says ninja-build
  says nowhere-dev
  [[ $err != *fast-linker* && $err != *g++* ]] || is "what it says" "$err" "only what is missing and needed"
}

scenario_without_apt_a_prefix_can_be_named()
{
  rm "$bin/apt-get" "$bin/dpkg-query"
  mkdir -p "$scratch/my prefix/include/sub/nowhere"
  touch "$scratch/my prefix/include/sub/nowhere/here.h"
  CMAKE_PREFIX_PATH="/none:$scratch/my prefix" start run a.prm
  is calls "$calls" "$full_set_up"
  is status "$status" 7
}

scenario_failed_build_shows_the_compiler()
{
  touch "$state/broken"
  start run a.prm
  is status "$status" 1
  is output "$out" ""
  says "dem/a.cc:3: error: expected ';'"
  rm "$state/broken"
  start run a.prm
  is "calls after the repair" "$calls" "ninja breccia"
}

scenario_two_starts_build_once()
{
  echo 0.5 >"$state/build-seconds"
  PATH=$bin "$house/breccia" one >"$scratch/out-1" 2>/dev/null &
  sleep 0.2
  PATH=$bin "$house/breccia" two >"$scratch/out-2" 2>/dev/null || true
  wait $! || true
  is calls "$(<"$state/calls")" "$full_set_up"
  is outputs "$(cat "$scratch/out-1" "$scratch/out-2")" $'<one>\n<two>'
}

scenario_interrupted_build_leaves_with_130_and_is_taken_up_again()
{
  echo 5 >"$state/build-seconds"
  status=0
  PATH=$bin timeout --preserve-status -s INT 0.5 "$house/breccia" run a.prm >/dev/null 2>"$scratch/err" || status=$?
  is status "$status" 130
  rm -rf "$state/building"
  echo 0 >"$state/build-seconds"
  start run a.prm
  is calls "$calls" "ninja breccia"
}

scenario_tests_build_everything_and_pass_the_status_on()
{
  start test -R "some test"
  is calls "$calls" $'cmake --preset release --fresh\nninja all\nctest --output-on-failure --parallel '"$(nproc)"' -R some test'
  is "folder of ctest" "$(<"$state/ctest-folder")" "$house/build/release"
  is status "$status" 8
  start run a.prm
  is "calls of a run after it" "$calls" ""
  start test --fast
  is calls "$calls" "ctest --output-on-failure --parallel $(nproc) -L ^fast\$"
}

scenario_help_of_the_tests_builds_nothing()
{
  local words typed
  for words in "test --help" "test -h" "help test"; do
    read -r -a typed <<<"$words"
    start "${typed[@]}"
    is "calls of $words" "$calls" ""
    is "status of $words" "$status" 0
    [[ $out == *"./breccia test --fast"* ]] || is "output of $words" "$out" "... ./breccia test --fast ..."
  done
}

for scenario in $(declare -F | sed -n 's/^declare -f scenario_//p'); do
  house="$scratch/a house"
  from=
  new_house
  "scenario_$scenario"
  printf 'ran %s\n' "$scenario"
done
rm -rf "$scratch"
((failures == 0))
