#!/usr/bin/env bash
# Imported models against Pinocchio, MuJoCo and OpenSim (peers.py): the fixtures here, and humanoids of
# Python packages. Skipped without Python or its packages (pin, example-robot-data, mujoco, gymnasium,
# dm-control, opensim); AMBULO_PYTHON names another Python, AMBULO_URDF, AMBULO_MJCF and AMBULO_OSIM
# other files, separated by ':'.
set -u
here=$(cd "$(dirname "$0")" && pwd)
ambulo=${AMBULO:-build/ambulo}
python=${AMBULO_PYTHON:-python3}
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-import-XXXXXX")
trap 'rm -rf "$scratch"' EXIT
"$ambulo" import "$here/every_joint.urdf" >/dev/null 2>"$scratch/said"
if grep -q 'built without expat' "$scratch/said"; then
  echo 'skipped: imported models against peers (built without expat)'
  echo '[  SKIPPED ]'
  exit 0
fi
if ! "$python" -c 'import numpy' 2>/dev/null; then
  echo 'skipped: imported models against peers (no Python with numpy)'
  echo '[  SKIPPED ]'
  exit 0
fi
"$python" "$here/peers.py" "$ambulo" "$scratch" | tee "$scratch/log"
status=${PIPESTATUS[0]}
grep -q '^0 passed, 0 failed' "$scratch/log" && echo '[  SKIPPED ]'
exit "$status"
