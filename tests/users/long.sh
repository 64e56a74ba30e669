#!/usr/bin/env bash
# Ways of four kinds of users, from what they have to what they want to see:
#
#   opensim  a model of OpenSim to a walk, beside a measured motion, and back into OpenSim
#   measured a walk that was measured, beside that of its model; its torques, beside OpenSim's
#   study    subjects times a device: a batch, its table in pandas, its page, its notebook
#   urdf     a humanoid robot to a trajectory, replayed in Pinocchio
#   tasks    lift, stairs, run: each solved, and its page used in a browser
#
# Arguments: only these ways. What needs pandas, Pinocchio, OpenSim or chromium skips with a word.
# AMBULO_PYTHON names another Python, AMBULO_OSIM a model with the coordinates of Rajagopal's (one
# named so is taken of several, separated by ':'), AMBULO_MOTION a motion measured with it (STO, MOT, CSV),
# AMBULO_URDF a humanoid on its feet of boxes; without it the G1 of example-robot-data, if it is there.
# AMBULO_SUBJECTS=500 makes the study as large as it is shipped (3). Prints "N passed, N failed".
set -u
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
AMBULO=${AMBULO:-$top/build/ambulo}
AMBULO=$(cd "$(dirname "$AMBULO")" && pwd)/$(basename "$AMBULO")
python=${AMBULO_PYTHON:-python3}
case ${MODE:-} in
*-fsanitize=* | *--coverage*)
  echo '[  SKIPPED ]'
  echo 'skipped: tests/users/long.sh: what users do is done with what users build'
  exit 0
  ;;
esac
export OPENBLAS_NUM_THREADS=1 LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1
models=$("$AMBULO" --models)
# both before the folder changes
osim=$(tr ':' '\n' <<<"${AMBULO_OSIM:-}" | grep -i rajagopal | head -n 1)
osim=$(realpath "${osim:-$here/walker.osim}")
motion=${AMBULO_MOTION:+$(realpath "$AMBULO_MOTION")}
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-users-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

check() { # NAME COMMAND...: counts, and shows the output of what failed
  local name=$1
  shift
  if "$@" >"$work/log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
    tail -n 20 "$work/log" | sed 's/^/  /'
  fi
}
counted() { # COMMAND...: says and counts what it prints as "N passed, N failed"
  local status=0
  "$@" >"$work/log" 2>&1 || status=$?
  grep -v '^[0-9]* passed, ' "$work/log"
  # shellcheck disable=SC2046
  set -- $(sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$work/log")
  passed=$((passed + ${1:-0})) failed=$((failed + ${2:-0}))
  [ "$status" = 0 ] || [ "${2:-0}" != 0 ] || failed=$((failed + 1))
}
has() { # MODULE WHAT
  "$python" -c "import $1" 2>/dev/null && return
  echo "skipped: $2 (no Python with $1)"
  return 1
}
optimal() { grep -q '"verdict": "optimal"' "$1/summary.json"; }
between_too() { ! grep -q 'nodes only\|off between the nodes' "$1"; }
imports() {
  "$AMBULO" import "$models/../tests/import/every_joint.urdf" 2>&1 | grep -q 'built without expat' || return 0
  echo "skipped: $1 (built without expat)"
  return 1
}

# --------------------------------------------------------------- OpenSim

import_walker() { # OSIM FILE
  "$AMBULO" import "$1" -o "$2" \
    --heel right=calcn_r:0,0,-0.03:0,0,0.03 --toe right=calcn_r:0.18,0,-0.04:0.18,0,0.04 \
    --heel left=calcn_l:0,0,-0.03:0,0,0.03 --toe left=calcn_l:0.18,0,-0.04:0.18,0,0.04
}
# a stand-in for a measured motion (measured.sh has a real one): three strides of another body at another speed, pelvis above the ground
as_measured() { # FILE
  "$AMBULO" solve "$models/walk_normal.yaml" -o other --samples 65 -q || return 1
  awk -F '\t' -f "$here/measured.awk" other/motion.sto >"$1"
}
alike() { # CURVE LEAST CORRELATION, of compared.json
  tr '\n' ' ' <compared.json | grep -o "\"$1\": {[^}]*" | grep -o '"r": [-0-9.]*' |
    awk -v least="$2" '{ print; good = $2 >= least } END { exit !good }'
}
opensim() {
  imports 'a model of OpenSim to a walk' || return
  local deviation=0.0001 # m: scene.json has places to 0.1 mm
  [ "$osim" = "$here/walker.osim" ] || deviation=0.003 # knees whose splines are frozen
  check 'import' import_walker "$osim" walker.yaml
  check 'a problem' "$AMBULO" new walk --for walker.yaml -o walk.yaml
  check 'check' "$AMBULO" check walk.yaml
  "$AMBULO" solve walk.yaml -o walk --samples 161 >said 2>&1
  check 'an imported model walks, from zero' optimal walk
  check 'and between the nodes too' between_too said
  if [ -n "$motion" ]; then cp "$motion" measured.sto; else check 'a motion' as_measured measured.sto; fi
  check 'the motion as curves' "$AMBULO" compare measured.sto --cycles cycles.csv
  check 'the walk beside it' sh -c "'$AMBULO' compare walk cycles.csv --json >compared.json"
  check 'hips go alike' alike hip_flexion 0.9
  check 'knees go alike' alike knee_flexion 0.8
  check 'torques of the motion, with its masses' "$AMBULO" inverse walker.yaml measured.sto -o torques.csv
  check 'its page, with the motion as a ghost' "$AMBULO" report walk --motion measured.sto --body walker.yaml
  check 'no column is missing' sh -c "! '$AMBULO' inverse walker.yaml walk/motion.csv 2>&1 | grep 'no column'"
  ! has opensim 'the walk in OpenSim' || counted "$python" "$here/in_opensim.py" "$osim" walk $deviation
}

# ----------------------------------------------------------------- study

study() {
  local subjects=${AMBULO_SUBJECTS:-3}
  head -n $((subjects + 1)) "$models/sweep_exoskeleton_subjects.csv" >sweep_exoskeleton_subjects.csv
  sed "s|^base: |&$models/|" "$models/sweep_exoskeleton.yaml" >study.yaml
  check 'the list of cases' "$AMBULO" batch study.yaml --dry-run
  "$AMBULO" batch study.yaml -o study -q >said 2>&1 # its table says what has no solution
  check 'the table' "$AMBULO" collect study
  check 'the page' "$AMBULO" report study
  check 'a line for each case' test "$(grep -vc '^#' study/results.csv)" = $((3 * subjects + 1))
  check 'every case in the page' every_case study
  if has pandas 'the table in pandas'; then
    counted "$python" "$here/table.py" study/results.csv "$subjects"
    ! has cffi 'the notebook of the study' || ! has matplotlib 'the notebook of the study' ||
      check 'the notebook of the study' notebook "$subjects"
  fi
}
every_case() { # FOLDER: each name of the table, with its motion, in 1.2 MB
  local id
  local table
  table=$("$top/tests/show/table_of.sh" "$1/report.html")
  cut -d , -f 1 "$1/results.csv" | grep -v '^#' | tail -n +2 | while read -r id; do
    grep -q "\"$id\"" <<<"$table" || return 1
  done || return 1
  ! grep -o '"pictures":\[\[' <<<"$table" && [ "$(wc -c <"$1/report.html")" -le 1200000 ]
}
notebook() { # SUBJECTS: with the package as it is built, on what was solved before
  local solved
  solved=$(cat study/cases/*/*.json | cksum)
  "$python" "$top/src/python/package.py" stage "$(dirname "$AMBULO")/libambulo.so" python &&
    MPLBACKEND=Agg PYTHONPATH=python AMBULO_SUBJECTS=$1 AMBULO_STUDY=. \
      "$python" "$here/notebook.py" "$top/docs/examples/exoskeleton_study.ipynb" &&
    [ "$solved" = "$(cat study/cases/*/*.json | cksum)" ]
}

# ------------------------------------------------------------------ urdf

humanoid() {
  [ -z "${AMBULO_URDF:-}" ] || { tr ':' '\n' <<<"$AMBULO_URDF" | head -n 1; return; }
  "$python" - <<'END' 2>/dev/null
import glob, os, pinocchio
up = os.path.dirname(pinocchio.__file__)
for folder in ("../../../../share", "../../cmeel.prefix/share"):
    for path in glob.glob(os.path.join(up, folder, "example-robot-data/robots/g1_description/urdf/g1_29dof_rev_1_0.urdf")):
        print(os.path.realpath(path))
        raise SystemExit
END
}
a_robot_walks() { # URDF
  check "import $(basename "$1")" "$AMBULO" import "$1" -o biped.yaml --force
  check 'a problem' "$AMBULO" new walk --for biped.yaml -o walk.yaml --force
  check 'check' "$AMBULO" check walk.yaml
  "$AMBULO" solve walk.yaml -o trajectory --force >said 2>&1
  check 'a robot walks, from zero' optimal trajectory
  check 'its page' "$AMBULO" report trajectory
  if between_too said; then
    echo "$(basename "$1"): optimal, between the nodes too"
  else
    echo "$(basename "$1"): optimal, but not between the nodes"
  fi
  ! has pinocchio 'the trajectory in Pinocchio' ||
    counted "$python" "$here/replay.py" "$1" biped.yaml trajectory/motion.csv
}
urdf() {
  imports 'a robot to a trajectory' || return
  a_robot_walks "$here/biped.urdf"
  check 'the small robot keeps to it between the nodes' between_too said
  local real
  real=$(humanoid)
  if [ -z "$real" ]; then
    echo 'skipped: a real humanoid (no packages pin and example-robot-data, no AMBULO_URDF)'
    return
  fi
  a_robot_walks "$real"
}

# ----------------------------------------------------------------- tasks

tasks() {
  local name
  for name in lift stairs run; do
    check "ambulo new $name" "$AMBULO" new $name -o $name.yaml
    "$AMBULO" solve $name.yaml -o $name >said 2>&1
    check "$name" optimal $name
    check "$name: between the nodes too" between_too said
    check "the page of $name" "$AMBULO" report $name
  done
  mv lift/report.html lift.html && mv run/report.html run.html && mv stairs/report.html stairs_up.html
  browser_checks lift stairs_up run
}

# shellcheck source=tests/users/browser.sh
. "$here/browser.sh"
# shellcheck source=tests/users/measured.sh
. "$here/measured.sh"
[ $# -gt 0 ] || set -- opensim measured study urdf tasks
for way; do
  mkdir "$work/$way" && cd "$work/$way" || exit 1
  "$way"
done
cd / || exit 1
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
