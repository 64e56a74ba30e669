#!/usr/bin/env bash
# Exported models and motions, imported again and in OpenSim, Pinocchio and MuJoCo (peers.py). Skipped
# without expat or Python with numpy, in part without the packages opensim, pin and mujoco; AMBULO_PYTHON
# names another Python.
set -u
here=$(cd "$(dirname "$0")" && pwd)
ambulo=${AMBULO:-build/ambulo}
python=${AMBULO_PYTHON:-python3}
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-export-XXXXXX")
trap 'rm -rf "$scratch"' EXIT
"$ambulo" import "$here/../import/every_joint.urdf" >/dev/null 2>"$scratch/said"
if grep -q 'built without expat' "$scratch/said"; then
  echo 'skipped: exported models imported again (built without expat)'
  echo '[  SKIPPED ]'
  exit 0
fi
if ! "$python" -c 'import numpy' 2>/dev/null; then
  echo 'skipped: exported models imported again (no Python with numpy)'
  echo '[  SKIPPED ]'
  exit 0
fi
"$python" "$here/peers.py" "$ambulo" "$here/../../models" "$scratch"
