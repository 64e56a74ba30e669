#!/usr/bin/env bash
# fuzz.sh FOLDER SECONDS [TARGET...]: runs the targets that `make fuzz` has built in FOLDER, JOBS at a time,
# each for so many seconds, from its seeds and from what earlier runs found (FOLDER/found/TARGET).
# A line each: runs, inputs that reached something new, faults. What was read at a fault is kept in
# FOLDER/faults; FOLDER/TARGET FILE reads it again. Exit status 1 where there was a fault.
set -u
folder=$1 seconds=$2
shift 2
[ $# -gt 0 ] || set -- tests/fuzz/seeds/*
mkdir -p "$folder/faults" "$folder/logs"
export folder seconds OPENBLAS_NUM_THREADS=1
export ASAN_OPTIONS=allocator_may_return_null=1:detect_stack_use_after_return=0
export TMPDIR=${FUZZ_TMPDIR:-$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)}

# the words that readers know: keys, elements, columns
grep -ohE '"[A-Za-z_][A-Za-z0-9_.]{1,30}"' -r src/files src/people src/import src/exchange src/study src/show/*.c \
  src/engine/problem | sort -u >"$folder/words"

fuzz_one() {
  local name=${1##*/} log status=0 runs new
  log=$folder/logs/$name
  mkdir -p "$folder/found/$name"
  "$folder/$name" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4000 -max_len=16384 -print_final_stats=1 \
    -dict="$folder/words" -artifact_prefix="$folder/faults/$name-" "$folder/found/$name" "tests/fuzz/seeds/$name" \
    >"$log" 2>&1 || status=1
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  new=$(sed -n 's/^stat::new_units_added: *//p' "$log")
  printf '%-10s %9s runs, %5s new inputs, %s\n' "$name" "${runs:-?}" "${new:-?}" \
    "$([ "$status" = 0 ] && echo 'no fault' || echo "FAULT: $(grep -m 1 -E 'FAULT|ERROR|runtime error' "$log")")"
  return "$status"
}
export -f fuzz_one
printf '%s\0' "$@" | xargs -0 -P "${JOBS:-2}" -I '{}' bash -c 'fuzz_one {}'
