#!/usr/bin/env bash
# Exported models and motions, imported again and in OpenSim, Pinocchio and MuJoCo (peers_export.py). Skipped
# without expat or Python with numpy, in part without the packages opensim, pin and mujoco; AMBULO_PYTHON
# names another Python.
set -u
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/support/peers.sh
. "$here/../support/peers.sh"
peers 'exported models imported again'
"$python" "$here/peers_export.py" "$ambulo" "$here/../../models" "$scratch"
