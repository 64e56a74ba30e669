# shellcheck shell=bash
# A walk that was measured, with the model it was measured with, beside the model's predicted walk, and
# its torques beside OpenSim's. Sourced by long.sh. The files are those of fetch_opensim.sh.

# The plates: the right foot strikes at 0.267 and 1.4115 s, the left one at 0.836 s. The record lasts from
# 0.45 to 1.799 s: more than a stride, but not from one strike of a foot to the next.
stride_time=1.1445

# rms and correlation of torques with OpenSim's, N m, where both have samples: NAME MOST LEAST-R
torque_is_theirs() {
  awk -v name="$1" -v most="$2" -v least="$3" '
    function column(word,  i) { for (i = 1; i <= NF; i++) if ($i == word) return i }
    FNR == 1 { part++; at = 0 }
    part == 1 && $1 == "time" { at = column(name "_moment"); next }
    part == 1 && at { theirs[sprintf("%.3f", $1)] = $at }
    part == 2 && /^#/ { next }
    part == 2 && /^time/ { $0 = $0; n = split($0, c, ","); for (i = 1; i <= n; i++) if (c[i] == "tau." name) at = i; next }
    part == 2 && at { split($0, c, ","); t = sprintf("%.3f", c[1])
      if (c[1] >= 0.5 && c[1] <= 1.75 && t in theirs) {
        x = theirs[t]; y = c[at]; k++; s += x; u += y; xx += x * x; yy += y * y; xy += x * y; d += (x - y)^2 } }
    END {
      if (k < 1000) exit 1
      r = (xy - s * u / k) / sqrt((xx - s * s / k) * (yy - u * u / k)); rms = sqrt(d / k)
      printf "%s: %.2f N m rms beside OpenSim, r %.4f\n", name, rms, r
      exit !(rms <= most && r >= least) }' "$data/id_walk.sto" torques.csv
}

measured() {
  local data=${AMBULO_OPENSIM:-$top/build/opensim} name
  imports 'a walk that was measured' || return
  if [ ! -f "$data/coordinates.sto" ]; then
    echo 'skipped: a walk that was measured (tests/users/fetch_opensim.sh build/opensim brings it; AMBULO_OPENSIM names another folder)'
    return
  fi
  data=$(realpath "$data")
  awk -F '\t' -v from=0.6 -v period=$stride_time -f "$here/stride.awk" "$data/coordinates.sto" >measured.sto
  check 'the motion as curves' "$AMBULO" compare measured.sto --cycles cycles.csv
  check 'the motion beside young adults' sh -c "'$AMBULO' compare measured.sto --json >compared.json"
  check 'it is a walk: hips' alike hip_flexion 0.98
  check 'it is a walk: knees' alike knee_flexion 0.98
  # the model as published walks as fast, in steps as long
  check 'import' import_walker "$data/Rajagopal2016.osim" walker.yaml
  check 'a problem' "$AMBULO" new walk --for walker.yaml --speed 1.243 --step-length 0.711 -o walk.yaml
  "$AMBULO" solve walk.yaml -o walk --samples 161 >said 2>&1
  check 'its model walks, from zero' optimal walk
  check 'and between the nodes too' between_too said
  check 'the walk beside the motion' sh -c "'$AMBULO' compare walk cycles.csv --json >compared.json"
  check 'hips go alike' alike hip_flexion 0.9
  check 'knees go alike' alike knee_flexion 0.8
  check 'ankles go alike' alike ankle_dorsiflexion 0.75
  "$AMBULO" compare walk cycles.csv | sed -n '1,9p'
  check 'its page, with the motion as a ghost' "$AMBULO" report walk --motion measured.sto --body walker.yaml
  ! has opensim 'the walk in OpenSim' || counted "$python" "$here/in_opensim.py" "$data/Rajagopal2016.osim" walk 0.003
  # the model scaled to the person, its motion and the forces under its feet
  check 'import of the person' import_walker "$data/subject_walk_scaled.osim" person.yaml
  check 'torques of the motion' "$AMBULO" inverse person.yaml "$data/coordinates.sto" --filter 6 --grf "$data/grf_walk.xml" -o torques.csv
  for name in hip_flexion_r hip_flexion_l; do
    check "$name is that of OpenSim" torque_is_theirs $name 1.2 0.999
    tail -n 1 "$work/log"
  done
  for name in hip_adduction_r knee_angle_r knee_angle_l; do
    check "$name is that of OpenSim" torque_is_theirs $name 0.7 0.999
    tail -n 1 "$work/log"
  done
  for name in ankle_angle_r ankle_angle_l; do
    check "$name is that of OpenSim" torque_is_theirs $name 0.25 0.9999
    tail -n 1 "$work/log"
  done
}
