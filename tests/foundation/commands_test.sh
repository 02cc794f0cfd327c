#!/usr/bin/env bash
# Runs the commands of README.md and doc/tutorials: every fenced block ```sh in which ./breccia is called, page by page, each page in a
# folder of its own.
#
#   commands_test.sh ROOT PROGRAM SCRATCH [PAGE]...
#
# A block after the line <!-- takes long --> is looked at instead of run: `check` in place of `run`, `transfer` and `study`, `--help` in place of
# what a benchmark or an inversion does. After <!-- shortened by WORDS --> it is run, with these words added to each `run` and `calibrate` of it. `check` of a
# shipped scene as it is, is left to "apps: Every scene that is shipped is valid and can be set up, and its page explains what check doubts".
# `./breccia test` would run this test again, and `./breccia python` would build; both are passed over.
set -euo pipefail

root=$1 program=$2 scratch=$3
shift 3
pages=("$@")
((${#pages[@]})) || pages=("$root/README.md" "$root"/doc/tutorials/*.md)

rm -rf "$scratch"
mkdir -p "$scratch"
faults=0

fault()
{
  printf 'FAULT %s\n' "$*"
  faults=$((faults + 1))
}

# What a page calls ./breccia: the program, or what looks at the same without the time.
write_stand_in()
{
  cat >"$1" <<EOS
#!/usr/bin/env bash
set -euo pipefail
program='$program'
EOS
  cat >>"$1" <<'EOS'
timed()
{
  local started=$SECONDS
  if [[ $1 == check && $# == 2 && $2 =~ ^apps/scenes/[^/]+\.prm$ && -f $2 ]]; then
    exit 0
  fi
  "$program" "$@" || exit
  printf '%5d s  %s\n' $((SECONDS - started)) "$*" >>"$TIMES"
  exit 0
}
if [[ $1 == test || $1 == python ]]; then # of the launcher
  exit 0
elif [[ ${TAKES_LONG:-} == yes && ($1 == bench || $1 == invert) ]]; then
  timed "$@" --help
elif [[ ${TAKES_LONG:-} == yes && ($1 == run || $1 == transfer || $1 == study || $1 == calibrate) ]]; then
  kept=()
  shift
  while (($#)); do
    case $1 in
      --resume | --restart | --identify) ;;
      -o | --output) shift ;;
      *) kept+=("$1") ;;
    esac
    shift
  done
  timed check "${kept[@]}"
elif [[ -n $SHORTENED && ($1 == run || $1 == calibrate) ]]; then
  eval "words=($SHORTENED)"
  timed "$@" "${words[@]}"
fi
timed "$@"
EOS
  chmod +x "$1"
}

# blocks PAGE FOLDER: writes block_NN.sh, first line "# short", "# long" or "# shortened by WORDS", and stray lines to FOLDER/stray
blocks()
{
  awk -v folder="$2" '
    /^<!-- takes long -->$/ { how = "long"; next }
    /^<!-- shortened by .* -->$/ { how = substr($0, 6, length($0) - 9); next }
    /^```sh$/ && !inside { inside = 1; file = sprintf("%s/block_%02d.sh", folder, ++n); print "# " (how ? how : "short") > file; next }
    /^```/ { inside = 0; how = ""; next }
    inside { print > file; next }
    /^ *\.\/breccia / { print FNR ": " $0 > (folder "/stray") }
    NF { how = "" }' "$1"
}

for page in "${pages[@]}"; do
  folder=$scratch/$(tr / _ <<<"${page#"$root"/}")
  mkdir -p "$folder"
  ln -s "$root/apps" "$root/meshes" "$folder/"
  write_stand_in "$folder/breccia"
  blocks "$page" "$folder"
  [[ ! -f $folder/stray ]] || fault "$page: not in a block \`\`\`sh: $(<"$folder/stray")"
  for block in "$folder"/block_*.sh; do
    if [[ ! -f $block ]] || ! grep -q '\./breccia' "$block"; then
      continue
    fi
    long=no words=
    case $(head -n 1 "$block") in
      '# long') long=yes ;;
      '# shortened by '*) words=$(head -n 1 "$block" | sed 's/^# shortened by //') ;;
    esac
    started=$SECONDS
    if (cd "$folder" && TAKES_LONG=$long SHORTENED=$words TIMES=$scratch/times.txt bash -euo pipefail "$block") >"$block.log" 2>&1; then
      printf 'ok    %4d s  %s %s\n' $((SECONDS - started)) "$(basename "$page")" "$(grep -m 1 '\./breccia' "$block")"
    else
      fault "$page: this block fails:"
      cat "$block"
      tail -n 12 "$block.log"
    fi
  done
done
printf 'The commands that took longest, of %d s:\n' "$SECONDS"
sort -rn "$scratch/times.txt" | head -n 15 || true
((faults == 0))
