#!/usr/bin/env bash
# Kills supervisors and workers at random, resumes, and compares the collected table with that of
# an undisturbed run, byte by byte. KILLS (default 12), SWEEP, SEED may
# be set.
set -u
here=$(cd "$(dirname "$0")" && pwd)
AMBULO=${AMBULO:-$here/../../build/ambulo}
SWEEP=${SWEEP:-$here/pendulums.yaml}
KILLS=${KILLS:-12}
RANDOM=${SEED:-1}
export OPENBLAS_NUM_THREADS=1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-kill-XXXXXX")
trap 'rm -rf "$scratch"' EXIT

"$AMBULO" batch "$SWEEP" -o "$scratch/calm" -j 1 --quiet
"$AMBULO" collect "$scratch/calm" >/dev/null || { echo 'the calm run is incomplete'; exit 1; }

# a process that a batch of ours started: a child of the supervisor
children() { ps -o pid= --ppid "$1" 2>/dev/null; }

kills=0 rounds=0 restarts=0
# (the shell's own news of killed processes is not shown)
{
while [ "$kills" -lt "$KILLS" ] && [ "$rounds" -lt $((20 * KILLS)) ]; do
  rounds=$((rounds + 1))
  "$AMBULO" batch "$SWEEP" -o "$scratch/wild" -j 2 --quiet >/dev/null 2>&1 &
  supervisor=$!
  while [ "$kills" -lt "$KILLS" ] && kill -0 "$supervisor" 2>/dev/null; do
    sleep "0.0$((RANDOM % 10))$((RANDOM % 10))"
    victim=$supervisor
    if [ $((RANDOM % 3)) != 0 ]; then victim=$(children "$supervisor" | shuf -n 1); fi
    [ -n "$victim" ] && kill -9 "$victim" 2>/dev/null && kills=$((kills + 1))
  done
  wait "$supervisor" 2>/dev/null
  [ "$kills" -ge "$KILLS" ] || restarts=$((restarts + 1))
  # all done before all kills were dealt: begin anew, of the finished cases some are taken away
  if [ "$("$AMBULO" batch --status "$scratch/wild" | awk '/^missing/ { print $2 }')" = 0 ]; then
    [ "$kills" -ge "$KILLS" ] || find "$scratch/wild/cases" -mindepth 2 -maxdepth 2 -name '*.json' |
      shuf -n 9 | xargs -r rm -f
  fi
done
} 2>/dev/null
"$AMBULO" batch "$SWEEP" -o "$scratch/wild" -j 2 --quiet
"$AMBULO" collect "$scratch/wild" || { echo 'the killed run is incomplete'; exit 1; }
left=$(find "$scratch/wild" -name '*.tmp-*' -o -name '*.old-*' | wc -l)
echo "$kills kills, $restarts restarts, $left leftovers"
for table in results.csv results.jsonl; do
  cmp "$scratch/calm/$table" "$scratch/wild/$table" || exit 1
done
[ "$left" = 0 ]
