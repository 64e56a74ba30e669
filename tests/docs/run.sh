#!/usr/bin/env bash
# What the pages say is done: every block of code in README.md, docs/*.md and the --help of each
# command is run as it stands, twice.
#
#   clone      in a copy of the sources with the program in build/, all pages in one folder, in the
#              order in which the README names them
#   installed  below a prefix of its own, without the sources: every page in a new folder that
#              holds nothing but the shipped models
#
# The examples of --help run in a new folder, too. Shell blocks are run by bash and end at the first
# command that fails; C programs are compiled and run by the page's own lines; complete YAML files
# are checked, fragments in the shipped file that they name; the Python blocks of a page are one
# script, without those that begin with "# needs MODULE, ..." where a module is missing, and none
# where Python 3 has no cffi and numpy. exceptions.txt tells what is not run and
# why; a block or a line that is neither run nor told there fails, and so does an exception that fits
# nothing. sbatch and parallel are stand-ins (stand_ins/), and rsvg-convert and ffmpeg where they are missing; make
# check-slurm has the real ones of the former.
#
# Prints "N passed, N failed". Environment: OUT (build folder), CC, CFLAGS, LDFLAGS, MODE as in
# tests/api/run.sh. DOCS_WHOLE=1: sweep_walk.yaml with all its cases, not a few, and what
# exceptions.txt calls slow. Arguments: only these pages (README.md, docs/..., help-solve). Without any, the
# README, the first hour and --help run as installed, and the facts of all pages are judged; `--all`
# (make check-long) runs every page in both places, the two side by side.
set -u
[ -z "${DOCS_TEST:-}" ] || { echo 'it runs itself: a page may not ask for make check'; exit 1; }
export DOCS_TEST=1
shopt -s nullglob
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
cd "$top" || exit 1
out=$(cd "${OUT:-build}" && pwd) || exit 1
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-docs-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL VARIANT
export OPENBLAS_NUM_THREADS=1 LC_ALL=C.UTF-8
passed=0 failed=0
# shellcheck source=tests/docs/pages.sh
. "$here/pages.sh"

# count NAME COMMAND...: counts, and shows the output of what failed
count() {
  local name=$1
  shift
  if "$@" >"$work/${where:-}log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
    tail -n 25 "$work/${where:-}log" | sed 's/^/  /'
  fi
}

# ------------------------------------------------------------ exceptions

# "PAGE | beginning of a line | where | why", where: clone, installed, both, or slow, which is both
# unless DOCS_WHOLE is 1
exception() { # PAGE WHERE LINE: is there one?
  local page start where why number=0 line=${3#"${3%%[! ]*}"}
  while IFS='|' read -r page start where why; do
    number=$((number + 1))
    page=${page%% *} start=${start# } start=${start% } where=${where// /}
    [ "$page" = "$1" ] || continue
    case $where in "$2" | both | slow) ;; *) continue ;; esac
    case $line in "$start"*) ;; *) continue ;; esac
    echo "$number" >>"$work/used"
    [ "$where${DOCS_WHOLE:-}" = slow1 ] || return 0
  done <"$work/exceptions"
  return 1
}
read_exceptions() {
  grep -v '^ *\(#\|$\)' "$here/exceptions.txt" >"$work/exceptions"
  ! grep -vE '^[^ |]+ \| [^|]+ \| (clone|installed|both|slow) \| [^|]+$' "$work/exceptions"
}
every_exception_fits() {
  local number
  sort -un "$work/used" >"$work/used.sorted"
  for number in $(seq "$(wc -l <"$work/exceptions")"); do
    grep -qx "$number" "$work/used.sorted" || { sed -n "${number}p" "$work/exceptions"; false; } || return 1
  done
}

# ---------------------------------------------------------------- worlds

# what the pages call files of your own
make_given() { mkdir -p "$work/given" && in_world installed "$work/given" sh "$here/given.sh"; }
give() { cp "$work/given"/* "$1/"; }

# a sweep of two hundred walks is cut to three, of its speeds, a front of twelve points to three: what
# the commands do with them is the same; so is what a coarser lift shows
shorten() {
  [ "${DOCS_WHOLE:-}" = 1 ] && return
  sed -i 's/values: \[1.0, .*/values: [1.0, 1.26, 1.6]}/; s/values: \[1.60.*/values: [1.75]}/; s/values: \[55.*/values: [75]}/; s/values: \[female.*/values: [male]}/' \
    "$1/sweep_walk.yaml" &&
    sed -i 's/points: 12/points: 3/' "$1/front_walk.yaml" &&
    sed -i 's/intervals: 112/intervals: 72/' "$1/lift.yaml"
}

make_clone() {
  mkdir -p "$work/clone/build/obj" "$work/clone-home"
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files -coz --exclude-standard
  else
    find . -path ./build -prune -o -type f -print0
  fi | while IFS= read -r -d '' file; do [ -e "$file" ] && printf '%s\0' "$file"; done |
    tar -c --null -T - | tar -x -C "$work/clone" || return 1
  cp -a "$out"/ambulo "$out"/libambulo.* "$work/clone/build/" || return 1
  cp -a "$out"/obj/src "$out"/obj/flags "$out"/obj/libambulo.a.sources "$work/clone/build/obj/" || return 1
  touch "$work/clone/build/.found" "$work/clone/build/.ready-build" "$work/clone/build/.ready-test"
  shorten "$work/clone/models"
}

make_prefix() {
  make --no-print-directory -o all OUT="$out" install PREFIX="$work/prefix" || return 1
  shorten "$work/prefix/share/ambulo/models"
  mkdir -p "$work/installed" "$work/installed-home"
}

# the compiler of the build, with the flags of its variant
make_tools() {
  mkdir -p "$work/tools"
  local compiler=${CC:-cc} # by its path: the tool is called cc as well
  compiler="$(command -v "${compiler%% *}") ${compiler#"${compiler%% *}"}"
  printf '#!/bin/sh\nexec %s -std=c11 -Wall -Wextra -Werror %s "$@"\n' "$compiler" \
    "${MODE:-} ${CFLAGS:-} ${LDFLAGS:-}" >"$work/tools/cc"
  chmod +x "$work/tools/cc"
  cp "$here"/stand_ins/* "$work/tools/"
}

# in_world WHERE FOLDER COMMAND...
in_world() {
  local where=$1 folder=$2
  shift 2
  case $where in
  clone) (cd "$folder" && HOME=$work/clone-home PATH=$work/tools:$work/clone/build:$PATH \
    PKG_CONFIG_PATH=$work/clone-home/.local/lib/pkgconfig "$@") ;;
  installed) (cd "$folder" && HOME=$work/installed-home PATH=$work/tools:$work/prefix/bin:$PATH \
    PKG_CONFIG_PATH=$work/prefix/lib/pkgconfig "$@") ;;
  esac </dev/null
}

# ---------------------------------------------------------------- blocks

extract() { # NAME FILE HELP
  mkdir -p "$work/blocks/$1"
  awk -v PAGE="$1" -v OUT="$work/blocks/$1" -v HELP="$3" -f "$here/blocks.awk" "$2" \
    >"$work/blocks/$1/list"
}

is_shell() { # an indented block is one when it begins like a command
  case $1 in *.sh | *.help) return 0 ;; *.indented) ;; *) return 1 ;; esac
  head -n 1 "$1" | grep -qE '^(ambulo|make|cc|cp|for|seq|sbatch|sed|git|export|mkdir) '
}

# the lines of a block that are to be run; those of exceptions are left out with what continues them
wanted_lines() { # PAGE WHERE FILE
  local line target skip=0
  while IFS= read -r line; do
    [ $skip = 1 ] || ! exception "$1" "$2" "$line" || skip=1
    [ $skip = 1 ] || printf '%s\n' "$line"
    # of a target that is not made here, that there is one (make -n would run it: recursion)
    case $skip$2$line in 1clonemake\ *)
      target=${line#make } && printf "grep -q '^%s:' Makefile\n" "${target%% *}" ;;
    esac
    case $line in *\\) ;; *) skip=0 ;; esac
  done <"$3"
}

# the lines of a page that compile and run its C programs
compile_lines() { # PAGE WHERE
  local file
  for file in "$work/blocks/$1"/*.sh "$work/blocks/$1"/*.indented; do
    grep -q '^cc ' "$file" && wanted_lines "$1" "$2" "$file"
  done
}

yaml_block() { # WHERE FOLDER FILE: a whole file is checked; a fragment in place of what it names
  local models=$2/models kind host key
  kind=$(sed -n 's/^kind: *\([a-z]*\).*/\1/p' "$3")
  cp "$3" "$models/block.yaml"
  if [ -z "$kind" ]; then
    host=$(sed -n '1s/^# in \([a-z_0-9]*\.yaml\).*/\1/p' "$3")
    [ -n "$host" ] || { echo 'neither a whole file, nor does it say "# in FILE.yaml"'; return 1; }
    # the host without these keys and what they hold
    awk -v keys=" $(sed -n 's/^\([a-z_]*\):.*/\1/p' "$3" | tr '\n' ' ') $(sed -n '1s/.* without //; 1s/,//gp' "$3") " '
      /^[a-z_]+:/ { key = $1; sub(/:.*/, "", key); out = index(keys, " " key " ") }
      !out' "$models/$host" >"$models/block.yaml"
    cat "$3" >>"$models/block.yaml"
    kind=$(sed -n 's/^kind: *\([a-z]*\).*/\1/p' "$models/block.yaml")
  fi
  case $kind in
  sweep) in_world "$1" "$2" ambulo batch models/block.yaml --dry-run ;;
  fit) in_world "$1" "$2" ambulo fit models/block.yaml --dry-run ;;
  *) in_world "$1" "$2" ambulo check models/block.yaml ;;
  esac
}

c_block() { # WHERE FOLDER FILE: as the page's own lines compile and run it
  local name where=$1
  name=$(sed -n 's/^cc \([a-z]*\.c\) .*/\1/p' "$work/$where-compile" | head -n 1)
  [ -n "$name" ] || { echo 'the page has no line that compiles it'; return 1; }
  cp "$3" "$2/$name"
  (echo 'set -eE'; cat "$work/$where-compile") >"$work/$where-compile.sh"
  in_world "$1" "$2" bash "$work/$where-compile.sh"
}

# the shell blocks of a page are one session; says where it ended
session() { # WHERE FOLDER
  local status=0 where=$1
  in_world "$1" "$2" timeout 300 bash "$work/$where-session.sh" || status=$?
  [ $status = 0 ] || echo "exit code $status"
  return $status
}

# the Python package as src/python puts it together; none without Python, cffi and numpy
make_python() {
  "${PYTHON:-python3}" -c 'import cffi, numpy' 2>/dev/null || return 1
  "${PYTHON:-python3}" src/python/package.py stage "$out/libambulo.so" "$work/python"
}
is_python() { # FILE: are the modules that it needs there?
  local needs
  needs=$(sed -n '1s/^# needs //p' "$1")
  [ -z "$needs" ] || "${PYTHON:-python3}" -c "import $needs" 2>/dev/null
}
python_session() { # WHERE FOLDER
  local where=$1
  in_world "$1" "$2" env PYTHONPATH="$work/python" MPLBACKEND=Agg timeout 300 \
    "${PYTHON:-python3}" "$work/$where-session.py"
}

# run_page PAGE WHERE FOLDER: its session, then its programs and YAML
run_page() {
  local page=$1 where=$2 folder=$3 file place path first rest=()
  printf 'set -eE -o pipefail\ntrap '\''echo "at $place: $BASH_COMMAND"'\'' ERR\n' >"$work/$where-session.sh"
  compile_lines "$page" "$where" >"$work/$where-compile"
  : >"$work/$where-session.py"
  while IFS=$'\t' read -r file place; do
    path=$work/blocks/$page/$file
    first=$(head -n 1 "$path")
    if is_shell "$path"; then
      grep -q '^cc ' "$path" && continue # run with the programs
      { echo "place='$place'"; wanted_lines "$page" "$where" "$path"; } >>"$work/$where-session.sh"
    elif [ "$first" = '#!/bin/sh' ]; then # the script of docs/batch-format.md
      count "$place: the same as tests/study/slurm_array.sh" \
        diff "$path" <(sed '/^# sbatch/d' tests/study/slurm_array.sh)
      cp "$path" "$folder/slurm_array.sh"
    elif ! exception "$page" "$where" "$first"; then
      case $file in
      *.python) ! is_python "$path" || { echo "# $place"; cat "$path"; } >>"$work/$where-session.py" ;;
      *.c) rest+=("C program" c_block "$place" "$path") ;;
      *.yaml) rest+=("YAML" yaml_block "$place" "$path") ;;
      *) count "$place: a block that is neither run nor in exceptions.txt: $first" false ;;
      esac
    fi
  done <"$work/blocks/$page/list"
  [ "$(grep -vc '^\(set\|trap\|place=\)' "$work/$where-session.sh")" = 0 ] ||
    count "$where: $page: commands" session "$where" "$folder"
  if [ -s "$work/$where-session.py" ] && [ -d "$work/python" ]; then
    count "$where: $page: Python" python_session "$where" "$folder"
  elif [ -s "$work/$where-session.py" ]; then
    echo "skipped: tests/docs/run.sh: Python of $page: no python3 with cffi and numpy"
  fi
  set -- "${rest[@]}"
  while [ $# -gt 0 ]; do
    count "$where: $3: $1" "$2" "$where" "$folder" "$4"
    shift 4
  done
}

pages() { # in the order of the README
  echo README.md
  sed -n '/^## Read on/,$p' README.md | grep -oE '\(docs/[a-z-]*\.md\)' | tr -d '()'
}

# ------------------------------------------------------------------ main

count 'exceptions.txt has four fields a line' read_exceptions
[ -z "${1:-}" ] || count 'a clone' make_clone # without arguments, nothing runs there
count 'make install' make_prefix
make_tools
make_python >"$work/log" 2>&1 || rm -rf "$work/python"
count 'files of your own' make_given
[ -z "${1:-}" ] || give "$work/clone"
for page in $(pages); do extract "$page" "$page" 0; done
"$out/ambulo" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' >"$work/commands"
"$out/ambulo" --help >"$work/help"
extract help "$work/help" 1
while read -r command; do
  "$out/ambulo" "$command" --help >"$work/help"
  count "ambulo $command --help: has an example" grep -q '^examples\?:' "$work/help"
  extract "help-$command" "$work/help" 1
done <"$work/commands"

# the pages of one place, in order: in the clone one folder for all, else a new one for each
run_pages() { # WHERE PAGE...
  local where=$1 page folder command
  shift
  for page in $(pages); do
    case " $* " in *" $page "*) ;; *) continue ;; esac
    folder=$work/clone
    if [ "$where" = installed ]; then
      folder=$work/installed/${page//\//_}
      mkdir -p "$folder"
      # what the README says to do first
      in_world installed "$folder" sh -c 'cp -r "$(ambulo --models)" .'
      give "$folder"
    fi
    run_page "$page" "$where" "$folder"
  done
  for folder in "$work/$where-overview" "$work/$where-help"; do
    mkdir -p "$folder"
    in_world "$where" "$folder" sh -c 'cp -r "$(ambulo --models)" .'
  done
  case " $* " in *' help '*) run_page help "$where" "$work/$where-overview" ;; esac
  give "$work/$where-help"
  while read -r command; do
    case " $* " in *" help-$command "*) run_page "help-$command" "$where" "$work/$where-help" ;; esac
  done <"$work/commands"
}
# the same in a process of its own, with counts in a file
beside() { # WHERE PAGE...
  (
    passed=0 failed=0
    run_pages "$@"
    echo "$passed $failed" >"$work/$1.counts"
  ) >"$work/$1.said" 2>&1 &
}

mapfile -t helps < <(sed 's/^/help-/' "$work/commands")
case ${1:-} in
'') run_pages installed README.md docs/tutorial.md help "${helps[@]}" ;;
--all)
  everything=("$(pages)" help "${helps[@]}")
  # shellcheck disable=SC2086
  for where in clone installed; do beside $where ${everything[*]}; done
  wait
  for where in clone installed; do
    cat "$work/$where.said"
    read -r good bad <"$work/$where.counts" || good=0 bad=1
    passed=$((passed + good)) failed=$((failed + bad))
  done
  count 'every exception fits something' every_exception_fits
  ;;
*) for where in clone installed; do run_pages $where "$@"; done ;;
esac
case ${1:-} in '' | --all) judge_pages ;; esac
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
