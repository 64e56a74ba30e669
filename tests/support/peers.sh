# shellcheck shell=bash
# What comparisons with other programs begin with. Sourced by tests/import/long_import.sh and tests/exchange/long_export.sh,
# from the folder that the tests are run from; AMBULO, AMBULO_PYTHON name another program, another Python.

# peers WHAT: sets ambulo (its path), python and scratch, a folder that goes at the end, in which
# whatever runs leaves what it leaves (OpenSim a log); or skips, with a word.
peers() {
  local probe
  ambulo=$(realpath "${AMBULO:-build/ambulo}")
  python=${AMBULO_PYTHON:-python3}
  # a path is seen from the folder that the tests are run from
  case $python in */*) python=$(realpath -s "$python") ;; esac
  probe=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../import/every_joint.urdf")
  scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-peers-XXXXXX") || exit 1
  trap 'cd / && rm -rf "$scratch"' EXIT
  "$ambulo" import "$probe" >/dev/null 2>"$scratch/said"
  ! grep -q 'built without expat' "$scratch/said" || skip_peers "$1 (built without expat)"
  (cd "$scratch" && "$python" -c 'import numpy') 2>/dev/null || skip_peers "$1 (no Python with numpy)"
}
skip_peers() {
  echo "skipped: $1"
  echo '[  SKIPPED ]'
  exit 0
}
