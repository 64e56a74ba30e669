#!/usr/bin/env bash
# A disk that fills up in the middle of a batch and is freed again, and one that turns read-only:
# one message each, exit code 4, and afterwards the table of an undisturbed run. The disk is a
# small tmpfs in a mount namespace of its own; skipped where that is not allowed.
set -u
here=$(cd "$(dirname "$0")" && pwd)
AMBULO=$(realpath "${AMBULO:-$here/../../build/ambulo}")
SWEEP=${SWEEP:-$here/pendulums.yaml}
export OPENBLAS_NUM_THREADS=1
if [ -z "${OWN_MOUNTS:-}" ]; then
  for way in '-m' '-rm'; do
    # shellcheck disable=SC2086
    unshare $way mount -t tmpfs none /mnt 2>/dev/null && OWN_MOUNTS=1 exec unshare $way "$0"
  done
  echo 'skipped: no file system can be mounted here'
  exit 0
fi
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-disk-XXXXXX")
trap 'umount "$scratch/disk" 2>/dev/null; rm -rf "$scratch"' EXIT
mkdir "$scratch/disk"
mount -t tmpfs -o size=8m none "$scratch/disk" || exit 1
faults=0
expect() { # what, exit code, expected code, a text that stderr holds
  if [ "$2" != "$3" ] || ! grep -qF -e "$4" "$scratch/err" || [ "$(grep -c error "$scratch/err")" != 1 ]; then
    echo "FAILED   $1: exit code $2, expected $3 and one message with '$4'"
    sed 's/^/         | /' "$scratch/err"
    faults=1
  fi
}

"$AMBULO" batch "$SWEEP" -o "$scratch/calm" -q && "$AMBULO" collect "$scratch/calm" >/dev/null || exit 1

head -c 7800k /dev/zero >"$scratch/disk/ballast"
"$AMBULO" batch "$SWEEP" -o "$scratch/disk/b" -j 2 -q 2>"$scratch/err"
expect 'a full disk' $? 4 'No space left on device'
kept=$("$AMBULO" batch --status "$scratch/disk/b" | awk '/^done/ { print $2 }')
rm "$scratch/disk/ballast"
"$AMBULO" batch "$SWEEP" -o "$scratch/disk/b" -j 2 >"$scratch/out" || faults=1
grep -q "18 of 18 cases done ($kept before)" "$scratch/out" ||
  { echo "FAILED   resumed after a full disk: $kept kept, $(cat "$scratch/out")"; faults=1; }

mount -o remount,bind,ro "$scratch/disk"
"$AMBULO" batch "$SWEEP" -o "$scratch/disk/b" -q 2>"$scratch/err"
expect 'a read-only folder' $? 4 'Read-only file system'
"$AMBULO" collect "$scratch/disk/b" >/dev/null 2>"$scratch/err"
expect 'a table in a read-only folder' $? 4 'Read-only file system'
"$AMBULO" batch "$SWEEP" -o "$scratch/disk/new" -q 2>"$scratch/err"
expect 'a new folder on a read-only disk' $? 4 'Read-only file system'
mount -o remount,bind,rw "$scratch/disk"

"$AMBULO" collect "$scratch/disk/b" >/dev/null
cmp "$scratch/calm/results.csv" "$scratch/disk/b/results.csv" || faults=1
left=$(find "$scratch/disk" -name '*.tmp-*' -o -name '*.old-*' | wc -l)
[ "$left" = 0 ] || { echo "FAILED   $left leftovers"; faults=1; }
[ "$faults" = 0 ] && echo "a full disk after $kept cases, a read-only one: the same table"
exit "$faults"
