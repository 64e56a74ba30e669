#!/usr/bin/env bash
# Robots and OpenSim models that nobody here ships walk as they come (zoo.txt, zoo.py); docs/zoo.md has the
# table. Arguments: only these models. Skipped without Python's packages (numpy, mujoco, pin,
# example-robot-data); AMBULO_PYTHON names another Python, AMBULO_OPENSIM_PYTHON one with opensim, AMBULO_ZOO
# the folder with mujoco_menagerie and opensim-models, of which what is not there is skipped.
set -u
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/support/peers.sh
. "$here/../support/peers.sh"
peers 'robots and persons walk as they come'
"$python" -c 'import mujoco, pinocchio' 2>/dev/null || skip_peers 'robots walk as they come (no Python with mujoco and pin)'
"$python" "$here/zoo.py" "$ambulo" "$here/zoo.txt" "$scratch" "$@"
