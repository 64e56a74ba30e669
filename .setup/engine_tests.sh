#!/usr/bin/env bash
# engine_tests.sh ARCHIVE OBJECT...: the test objects that need nothing beyond the engine's archive, a
# line each. Those that need more, as most do that read a problem file, are named on standard error
# with one symbol that they lack. Fails where a room of the engine, or the tests of the interface,
# would have none left.
set -u
archive=$1 bad=0
shift
defined=$(nm -g --defined-only "$archive" | awk 'NF == 3 { print $3 }' | sort -u)
declare -A kept more
for object in "$@"; do
  room=$(basename "$(dirname "$object")")
  lacking=$(nm -u "$object" | awk '$NF ~ /^ambulo_/ { print $NF }' | sort -u | comm -23 - <(echo "$defined") | head -n 1)
  kept[$room]=$((${kept[$room]:-0} + (${#lacking} == 0)))
  if [ -z "$lacking" ]; then
    echo "$object"
  else
    more[$room]="${more[$room]:-} $(basename "$object" .o) ($lacking)"
  fi
done
for room in "${!kept[@]}"; do
  echo "tests/$room: ${kept[$room]} with the engine alone${more[$room]:+; beyond it:${more[$room]}}" >&2
  [ "${kept[$room]}" != 0 ] || bad=1
done
exit $bad
