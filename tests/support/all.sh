#!/usr/bin/env bash
# Runs test programs and scripts (arguments, PROGRAM or PROGRAM:ARGUMENT), JOBS at a time, and sums up.
# The last line is "N passed, N failed"; the exit status is 0 only when nothing failed.
# Environment: OUT (build folder), JOBS, BUILD_STATUS (non-zero: something did not build),
# TEST_WRAPPER (a command put before each program), TEST_TIMEOUT in seconds, COUNTS (a file that gets
# a line "passed failed"), SEED (a number: in random order, which it gives again; else the longest first).
set -u
out=${OUT:-build}
logs=$out/logs
rm -rf "$logs"
mkdir -p "$logs"
export logs TEST_WRAPPER=${TEST_WRAPPER:-} TEST_TIMEOUT=${TEST_TIMEOUT:-900}
export OPENBLAS_NUM_THREADS=1 AMBULO
AMBULO=$(cd "$out" && pwd)/ambulo

# a locale with a decimal comma, for the tests that numbers do not follow it
if command -v localedef >/dev/null 2>&1; then
  if [ ! -d build/locale/de_DE.UTF-8 ]; then
    mkdir -p build/locale
    localedef -i de_DE -f UTF-8 build/locale/de_DE.UTF-8 >/dev/null 2>&1
  fi
  [ ! -d build/locale/de_DE.UTF-8 ] || export LOCPATH=$PWD/build/locale
fi

run_one() {
  local name=${1//\//_} begin=$SECONDS status=0 argument=
  case $1 in *:*) argument=${1#*:} ;; esac
  # shellcheck disable=SC2086
  timeout "$TEST_TIMEOUT" $TEST_WRAPPER "${1%%:*}" $argument >"$logs/$name.log" 2>&1 </dev/null || status=$?
  echo "$status" >"$logs/$name.status"
  local word=ok
  [ "$status" = 0 ] || word=FAILED
  printf '%-8s %s (%d s)\n' "$word" "$1" $((SECONDS - begin))
}
export -f run_one

programs=("$@")
# commands of the docs are about what users build, which is no variant of the compiler's
case ${MODE:-} in *-fsanitize=* | *--coverage*)
  for i in "${!programs[@]}"; do
    case ${programs[i]} in tests/docs/*) unset "programs[i]" ;; esac
  done
  echo 'skipped with the compiler instrumenting: tests/docs/run.sh'
  ;;
esac
present=() missing=()
for program in "${programs[@]}"; do
  if [ -x "${program%%:*}" ]; then present+=("$program"); else missing+=("$program"); fi
done
if [ -n "${SEED:-}" ]; then
  echo "random order, again with SEED=$SEED"
  mapfile -t present < <(printf '%s\n' "${present[@]}" | awk -v seed="$SEED" 'BEGIN { srand(seed) } { print rand(), $0 }' |
    sort -n | cut -d" " -f2-)
fi
# those of longest.txt first, in its order
[ ${#present[@]} = 0 ] || [ -n "${SEED:-}" ] || mapfile -t present < <(printf '%s\n' "${present[@]}" | awk -v list=tests/support/longest.txt '
  BEGIN { while ((getline line < list) > 0) place[line] = ++lines }
  {
    n = split($0, part, "/")
    name = part[n - 1] "/" part[n]
    print (name in place ? place[name] : lines + NR), $0
  }' | sort -n | cut -d" " -f2-)
[ ${#present[@]} = 0 ] || printf '%s\0' "${present[@]}" | xargs -0 -r -n1 -P "${JOBS:-1}" bash -c 'run_one "$1"' run_one

# sum of the numbers that a pattern (with one group) captures in a log
sum() { sed -nE "s/$2/\1/p" "$1" | awk '{ s += $1 } END { print s + 0 }'; }

passed=0 failed=0
for program in "${present[@]}"; do
  log=$logs/${program//\//_}.log
  status=$(cat "${log%.log}.status")
  good=$(sum "$log" '^\[  PASSED  \] ([0-9]+) test\(s\).*')
  bad=$(sum "$log" '^\[  FAILED  \] ([0-9]+) test\(s\).*')
  good=$((good + $(sum "$log" '^([0-9]+) passed, [0-9]+ failed$')))
  bad=$((bad + $(sum "$log" '^[0-9]+ passed, ([0-9]+) failed$')))
  if [ "$status" != 0 ]; then
    # a crash, a time-out or a sanitizer report ends a program before it can count
    [ "$bad" -gt 0 ] || bad=1
    printf '\n----- %s: exit status %s\n' "$program" "$status"
    grep -vE '^\[ (RUN|      OK) ' "$log" | tail -n 60
  elif [ $((good + bad)) = 0 ] && grep -q '^\[  SKIPPED \]' "$log"; then
    echo "skipped: $program"
  elif [ $((good + bad)) = 0 ]; then
    printf '\n----- %s: ran no test\n' "$program"
    bad=1
  fi
  grep '^skipped' "$log"
  passed=$((passed + good))
  failed=$((failed + bad))
done
for program in "${missing[@]}"; do
  echo "not built: $program"
  failed=$((failed + 1))
done
if [ "${BUILD_STATUS:-0}" != 0 ] && [ ${#missing[@]} = 0 ]; then
  echo 'the build failed; programs of an earlier build were run'
  failed=$((failed + 1))
fi
[ -z "${COUNTS:-}" ] || echo "$passed $failed" >>"$COUNTS"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
