#!/usr/bin/env bash
# Is the judge of `make truth` right? tests/truth/test_truth.py, with motions that are solved here and then
# spoilt. Skipped without Python with numpy and Pinocchio; AMBULO_PYTHON names another Python.
set -u
here=$(cd "$(dirname "$0")" && pwd)
python=${AMBULO_PYTHON:-python3}
if ! "$python" -c 'import numpy, pinocchio' 2>/dev/null; then
  echo 'skipped: faults that make truth must see (no Python with numpy and pinocchio)'
  echo '[  SKIPPED ]'
  exit 0
fi
case ${MODE:-} in
*-fsanitize=* | *--coverage*)
  echo '[  SKIPPED ]'
  echo 'skipped: tests/truth/long_truth.sh: what is judged is what users build'
  exit 0
  ;;
esac
export PYTHONDONTWRITEBYTECODE=1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-truth-XXXXXX") || exit 1
trap 'rm -rf "$scratch"' EXIT
models=$(cd "$here/../../models" && pwd)
# motions that have faults are expected: only whether there is a table counts
"$python" "$here/truth.py" --ambulo "${AMBULO:-build/ambulo}" --models "$models" --results "$scratch" \
  walk lift jump walk_exotendon >"$scratch/said" 2>&1
grep -q '^4 problems' "$scratch/said" || { tail -n 20 "$scratch/said"; exit 1; }
"$python" "$here/test_truth.py" "$scratch"
