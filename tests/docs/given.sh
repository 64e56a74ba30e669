#!/bin/sh
# Writes into the present folder what the pages call files of your own: measured curves, and
# motions, one with forces, as other programs write them. All are made up from a predicted walk, and
# serve to run the commands, not to judge anything. Needs ambulo on the PATH.
set -e
models=$(ambulo --models)
ambulo solve "$models/walk_normal.yaml" -o of_walk --samples 65 --quiet
ambulo inverse "$models/walk_normal.yaml" of_walk/motion.csv -o of_walk.csv 2>/dev/null

# curves of a layout that docs/compare.md names
{
  echo variable,percent,mean_deg,sd_deg
  for percent in 0 10 20 30 40 50 60 70 80 90 100; do
    echo "hip_flexion,$percent,$((35 - percent / 2)),5"
    echo "knee_flexion,$percent,$((5 + percent / 2)),5"
  done
} >adults.csv

cp "$models/lower_body_18.yaml" model.yaml
table() { # the columns whose names match $1, renamed by $2; angles (q.*) in degrees
  grep -v '^#' of_walk/motion.csv | awk -F , -v match_="$1" -v rename="$2" -v title="$3" '
    NR == 1 {
      for (i = 1; i <= NF; i++) if ($i ~ match_ || $i == "time") { take[++n] = i; name[i] = $i }
      header = ""
      for (k = 1; k <= n; k++) {
        i = take[k]; text = name[i]
        angle[i] = text ~ /^q\./ && text !~ /_t[xyz]$/
        if (rename == "q") sub(/^q\./, "", text)
        else {
          foot = text ~ /left/ ? "1_" : ""; axis = substr(text, length(text))
          if (text ~ /^grf/) text = foot "ground_force_v" axis
          else if (text ~ /^cop/) text = foot "ground_force_p" axis
        }
        header = header (k > 1 ? "\t" : "") text
      }
      next
    }
    {
      line[++rows] = ""
      for (k = 1; k <= n; k++) {
        value = $(take[k])
        if (angle[take[k]]) value *= 57.29577951308232
        if (value == "nan") value = 0
        line[rows] = line[rows] (k > 1 ? "\t" : "") sprintf("%.12g", value)
      }
    }
    END {
      printf "%s\nversion=1\nnRows=%d\nnColumns=%d\ninDegrees=yes\nendheader\n%s\n", title, rows, n, header
      for (r = 1; r <= rows; r++) print line[r]
    }'
}
table '^q\.' q Coordinates >ik.mot
table '^(grf|cop)\.' forces forces >grf.mot
load() { # BODY PREFIX: columns of a plate, as OpenSim's external loads name them
  echo "<ExternalForce name='$1'><applied_to_body>$1</applied_to_body>"
  echo "<force_identifier>$2ground_force_v</force_identifier>"
  echo "<point_identifier>$2ground_force_p</point_identifier></ExternalForce>"
}
{
  echo "<OpenSimDocument Version='40000'><ExternalLoads name='loads'><objects>"
  load calcn_r ''
  load calcn_l 1_
  echo '</objects><datafile>grf.mot</datafile></ExternalLoads></OpenSimDocument>'
} >external_loads.xml

# a robot on two legs, as a URDF, for docs/guide-import.md
limb() { # SIDE Y: hip, knee, ankle, and a foot of a box
  for part in "thigh hip trunk 0 $2 -0.1 -0.6 1.8 3" "shank knee thigh_$1 0 0 -0.4 -0.1 2.4 2" \
    "foot ankle shank_$1 0 0 -0.4 -0.8 0.8 1"; do
    # shellcheck disable=SC2086
    set -- "$1" "$2" $part
    echo "<link name='$3_$1'><inertial><origin xyz='0.02 0 -0.04'/><mass value='${11}'/>"
    echo "<inertia ixx='0.03' ixy='0' ixz='0' iyy='0.03' iyz='0' izz='0.01'/></inertial>"
    [ "$3" != foot ] || echo "<collision><origin xyz='0.04 0 -0.04'/>" \
      "<geometry><box size='0.2 0.08 0.02'/></geometry></collision>"
    echo "</link><joint name='$4_$1' type='revolute'><origin xyz='$6 $7 $8'/><parent link='$5'/>"
    echo "<child link='$3_$1'/><axis xyz='0 1 0'/><limit lower='$9' upper='${10}' effort='90' velocity='9'/></joint>"
  done
}
{
  echo "<robot name='stilts'><link name='trunk'><inertial><mass value='20'/>"
  echo "<inertia ixx='0.9' ixy='0' ixz='0' iyy='0.8' iyz='0' izz='0.4'/></inertial></link>"
  limb r -0.1
  limb l 0.1
  echo '</robot>'
} >robot.urdf

# a body without geometry, as an OpenSim model
bone() { # BODY PARENT X Y Z JOINT COORDINATE: coordinates of the joint
  echo "<Body name='$1'><mass>4</mass><mass_center>0 -0.1 0</mass_center><inertia_xx>0.05</inertia_xx>"
  echo "<inertia_yy>0.02</inertia_yy><inertia_zz>0.05</inertia_zz><Joint><$6 name='$7_joint'>"
  echo "<parent_body>$2</parent_body><location_in_parent>$3 $4 $5</location_in_parent><CoordinateSet><objects>"
  for coordinate in $7; do
    echo "<Coordinate name='$coordinate'><range>-1.5 1.5</range></Coordinate>"
  done
  echo "</objects></CoordinateSet></$6></Joint></Body>"
}
{
  echo "<OpenSimDocument Version='30000'><Model name='gait'><BodySet><objects>"
  bone pelvis ground 0 0 0 PlanarJoint 'pelvis_tilt pelvis_tx pelvis_ty'
  bone calcn_r pelvis 0 -0.9 0.1 PinJoint leg_r
  bone calcn_l pelvis 0 -0.9 -0.1 PinJoint leg_l
  echo '</objects></BodySet></Model></OpenSimDocument>'
} >gait.osim

# three strides, one after the other, as a CSV
awk -F '\t' -v OFS=, '
  /^time/ { $1 = $1; print "# inDegrees=yes"; print; on = 1; next }
  on { time[++n] = $1; $1 = ""; rest[n] = $0 }
  END {
    for (r = 0; r < 3; r++)
      for (i = 1; i < n; i++) print time[i] + r * time[n] rest[i]
  }' ik.mot >person.csv
rm -r of_walk of_walk.csv

# for the tutorials: a model and a motion of OpenSim, a robot
users=$(dirname "$0")/../users
cp "$users/walker.osim" "$users/biped.urdf" "$users/quadruped.urdf" .
awk -F '\t' -f "$users/measured.awk" ik.mot >measured.mot

# walks of people whose prices nobody knows, for docs/guide-fit.md: the left foot strikes at 0
people() { # NAME STEP_LENGTH DURATION
  ambulo solve "$models/walk_normal.yaml" -o of_people --force --quiet \
    --set gait.step_length="$2" --set time.duration="$3" --set gait.phases.toe_off=0.63 \
    --set 'objective[torque_power].scale.hip_adduction_r=0.0035' \
    --set 'objective[torque_power].scale.hip_adduction_l=0.0035' \
    --set 'objective[torque_power].scale.ankle_angle_r=0.0025' \
    --set 'objective[torque_power].scale.ankle_angle_l=0.0025' \
    --set 'objective[ankle_posture].weight=0.15'
  grep -v '^#' of_people/motion.csv | awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    { for (i = 1; i <= NF; i++) row[NR - 1, i] = $i; rows = NR - 1 }
    function curve(name, from, shift,    k, percent) {
      for (k = 1; k <= rows; k++) {
        percent = 100 * row[k, column["time"]] / row[rows, column["time"]]
        printf "%s,%.6g,%.6g,3\n", name, percent, 57.29577951308232 * row[k, column[from]] + shift
      }
    }
    END {
      print "variable,percent,mean_deg,sd_deg"
      curve("hip_flexion", "q.hip_flexion_l", 11.4)
      curve("hip_adduction", "q.hip_adduction_l", 0)
      curve("knee_flexion", "q.knee_angle_l", 0)
      curve("ankle_dorsiflexion", "q.ankle_angle_l", 0)
    }' >"people_$1.csv"
  rm -r of_people
}
people slow 0.60 0.60
people usual 0.68 0.54
people fast 0.76 0.49
