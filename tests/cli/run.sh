#!/usr/bin/env bash
# Tests of the program as a user meets it: each case of tests/cli/*.txt is a command with what
# it must print, write and return. AMBULO is the program (build/ambulo).
#
# A case is a block of lines "key: value"; blank lines separate blocks, '#' begins a comment.
#   name     what is tested
#   setup    shell commands before it (not judged)
#   run      the command; $AMBULO the program, $MODELS the shipped models
#   exit     expected exit code (0 if left out)
#   out err  a text that stdout / stderr contains (may be repeated)
#   not      a text that neither contains
#   silent   out or err: that stream stays empty
#   there    a path that exists afterwards (may be repeated)
#   writes   a shell pattern for entries that may appear; without it the folder stays as it was
#   cpu      seconds of processor time that must not be exceeded
#   bounded  why the program must keep to a small address space: skipped for one built with the
#            address sanitizer, which reserves terabytes
# Each case runs in an empty folder of its own. A machine may stall any process for a second at any
# place: a case that sends signals waits for states (until_*), and fits every order of what follows.
set -u
here=$(cd "$(dirname "$0")" && pwd)
AMBULO=${AMBULO:-build/ambulo}
AMBULO=$(cd "$(dirname "$AMBULO")" && pwd)/$(basename "$AMBULO")
MODELS=$(cd "$here/../../models" && pwd)
export AMBULO MODELS LC_ALL=C
export OPENBLAS_NUM_THREADS=1
[ -x "$AMBULO" ] || { echo "no program at $AMBULO"; echo "0 passed, 1 failed"; exit 1; }
grep -q __asan_init "$AMBULO" && sanitized=1 || sanitized=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-cli-XXXXXX")
trap 'chmod -R u+rwx "$scratch" 2>/dev/null; rm -rf "$scratch"' EXIT
passed=0 failed=0
filter=${1:-}
shopt -s extglob

# until a condition holds; or the process is gone, which what follows then shows
await() { # process, command
  until "${@:2}" 2>/dev/null || ! kill -0 "$1" 2>/dev/null; do sleep 0.02; done
}
has_worker() { ps -o pid= --ppid "$1" | grep -q .; }
until_worker() { await "$1" has_worker "$1"; }
# until it has handlers for the signals 2 (INT) and 15 (TERM): bits 1 and 14 of the mask
until_interruptible() { await "$1" grep -q '^SigCgt.*[4567cdef]..[2367abef]$' "/proc/$1/status"; }
until_says() { await "$1" grep -q -e "$2" "$3"; } # process, text, its file
# A file is another one (a sed script), or away (''), from when the list of a batch stands until the
# command ends. It is to name the file with exit code 4; or it was through before.
under() { # list of cases, file, script, what it is to say, command
  local list=$1 file=$2 script=$3 says=$4 status
  "${@:5}" 2>err & s=$!
  until [ -s "$list" ] || ! kill -0 $s 2>/dev/null; do :; done
  kill -STOP $s 2>/dev/null
  cp "$file" keep
  if [ -n "$script" ]; then sed -i "$script" "$file"; else rm "$file"; fi
  cmp -s keep "$file" && echo "not edited: $file"
  kill -CONT $s 2>/dev/null
  wait $s && status=0 || status=$?
  cp keep "$file"
  if [ $status = 4 ] && grep -q "$says" err; then
    echo "named $file"
  elif [ $status != 0 ]; then
    echo "WRONG $file: exit $status"; head -3 err
  fi
}
export -f under await has_worker until_worker until_interruptible until_says

reset() {
  name='' setup='' run='' code=0 silent='' writes='' cpu='' bounded=''
  out=() err=() not=() there=()
}

fault() {
  [ "$bad" = 0 ] && printf 'FAILED   %s: %s\n         %s\n' "$file" "$name" "$run"
  bad=1
  printf '         %s\n' "$1"
}

contains() { grep -qF -e "$2" "$1"; }

judge() {
  local text status=$1 entry
  [ "$status" = "$code" ] || fault "exit code $status, expected $code"
  for text in "${out[@]}"; do contains "$box.out" "$text" || fault "stdout lacks: $text"; done
  for text in "${err[@]}"; do contains "$box.err" "$text" || fault "stderr lacks: $text"; done
  for text in "${not[@]}"; do
    if contains "$box.out" "$text" || contains "$box.err" "$text"; then fault "printed: $text"; fi
  done
  case $silent in *out*) [ ! -s "$box.out" ] || fault 'stdout is not empty' ;; esac
  case $silent in *err*) [ ! -s "$box.err" ] || fault 'stderr is not empty' ;; esac
  for entry in "${there[@]}"; do [ -e "$box/$entry" ] || fault "not written: $entry"; done
  while read -r entry; do
    # shellcheck disable=SC2254
    case ${entry#./} in $writes) ;; *) fault "left behind: $entry" ;; esac
  done < <(comm -13 "$box.before" <(cd "$box" && find . -mindepth 1 -maxdepth 1 | sort))
  if [ -n "$cpu" ]; then
    local used
    used=$(awk '{ s += $1 + $2 } END { print s }' "$box.time")
    awk -v u="$used" -v l="$cpu" 'BEGIN { exit !(u > l) }' && fault "took $used s, expected $cpu s"
  fi
  [ "$bad" = 0 ] || { head -n 5 "$box.out" "$box.err" | sed 's/^/         | /'; }
}

finish() {
  [ -n "$run" ] || { reset; return; }
  case "$file $name" in *"$filter"*) ;; *) reset; return ;; esac
  if [ -n "$bounded" ] && [ "$sanitized" = 1 ]; then
    echo "skipped under the address sanitizer: $file: $name ($bounded)"
    reset
    return
  fi
  box=$scratch/box
  bad=0
  chmod -R u+rwx "$box" 2>/dev/null
  rm -rf "$box"* && mkdir "$box"
  [ -z "$setup" ] || (cd "$box" && eval "$setup") >/dev/null 2>&1
  (cd "$box" && find . -mindepth 1 -maxdepth 1 | sort) >"$box.before"
  local status=0 TIMEFORMAT='%U %S'
  # shellcheck disable=SC2016
  { time bash -c 'exec >"$1.out" 2>"$1.err" </dev/null; cd "$1" && eval "$2"' case "$box" "$run"; } \
    2>"$box.time" || status=$?
  judge "$status"
  if [ "$bad" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
  reset
}

for path in "$here"/*.txt; do
  file=$(basename "$path")
  reset
  while IFS= read -r line || [ -n "$line" ]; do
    key=${line%%:*} value=${line#*: }
    case $line in
      '') finish ;;
      '#'*) ;;
      name:* | setup:* | run:* | silent:* | writes:* | cpu:* | bounded:*)
        printf -v "$key" '%s' "$value" ;;
      exit:*) code=$value ;;
      out:*) out+=("$value") ;;
      err:*) err+=("$value") ;;
      not:*) not+=("$value") ;;
      there:*) there+=("$value") ;;
      *) echo "$file: not understood: $line"; failed=$((failed + 1)) ;;
    esac
  done <"$path"
  finish
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
