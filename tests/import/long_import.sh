#!/usr/bin/env bash
# Imported models against Pinocchio, MuJoCo and OpenSim (peers_import.py): the fixtures here, and humanoids of
# Python packages. Skipped without Python or its packages (pin, example-robot-data, mujoco, gymnasium,
# dm-control, opensim); AMBULO_PYTHON names another Python, AMBULO_URDF, AMBULO_MJCF and AMBULO_OSIM
# other files, separated by ':', AMBULO_OPENSIM the folder of tests/users/fetch_opensim.sh (build/opensim).
set -u
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/support/peers.sh
. "$here/../support/peers.sh"
peers 'imported models against peers'
"$python" "$here/peers_import.py" "$ambulo" "$scratch" | tee "$scratch/log"
status=${PIPESTATUS[0]}
grep -q '^0 passed, 0 failed' "$scratch/log" && echo '[  SKIPPED ]'
exit "$status"
