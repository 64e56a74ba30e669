#!/usr/bin/env bash
# Disturbs a batch at random, resumes it, and compares the collected table with that of an undisturbed
# run, byte by byte. The supervisor is killed, a worker, or all at once; one is stopped for a while; memory
# ends under all; the folder is moved away and back. KILLS (default 12), SWEEP, SEED may be set.
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

declare -A dealt
# what is done to the run of this supervisor; nothing counts that came too late
disturb() { # supervisor
  local kinds=(supervisor worker worker group stop folder) kind victim
  kind=${kinds[RANDOM % ${#kinds[@]}]}
  victim=$(children "$1" | shuf -n 1)
  case $kind in
    supervisor) kill -9 "$1" ;;
    worker) [ -n "$victim" ] && kill -9 "$victim" ;;
    # shellcheck disable=SC2046
    group) kill -9 "$1" $(children "$1") ;;
    stop)
      [ $((RANDOM % 2)) = 0 ] || victim=$1
      [ -n "$victim" ] && kill -STOP "$victim" && sleep 0.05 && kill -CONT "$victim"
      ;;
    folder)
      mv "$scratch/wild" "$scratch/away" && sleep 0.02
      rm -rf "$scratch/wild" # where the run began another
      mv "$scratch/away" "$scratch/wild"
      ;;
  esac || return
  kills=$((kills + 1))
  dealt[$kind]=$((${dealt[$kind]:-0} + 1))
}

kills=0 rounds=0 restarts=0
# (the shell's own news of killed processes is not shown)
{
while [ "$kills" -lt "$KILLS" ] && [ "$rounds" -lt $((20 * KILLS)) ]; do
  rounds=$((rounds + 1))
  limit=unlimited
  if [ $((RANDOM % 6)) = 0 ]; then # kB: between not enough to start and enough for all
    limit=$((200000 + 1000 * (RANDOM % 200))) kills=$((kills + 1))
    dealt[memory]=$((${dealt[memory]:-0} + 1))
  fi
  (ulimit -v "$limit" && exec "$AMBULO" batch "$SWEEP" -o "$scratch/wild" -j 2 --quiet >/dev/null 2>&1) &
  supervisor=$!
  while [ "$kills" -lt "$KILLS" ] && kill -0 "$supervisor" 2>/dev/null; do
    sleep "0.0$((RANDOM % 10))$((RANDOM % 10))"
    disturb "$supervisor"
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
echo "$kills disturbances, $restarts restarts, $left leftovers"
for kind in "${!dealt[@]}"; do echo "  $kind ${dealt[$kind]}"; done
for table in results.csv results.jsonl; do
  cmp "$scratch/calm/$table" "$scratch/wild/$table" || exit 1
done
[ "$left" = 0 ]
