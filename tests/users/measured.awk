# A stride as an STO or MOT to a motion as OpenSim's inverse kinematics writes it: three strides, one
# after the other, with the height of the pelvis above the ground. awk -F '\t' -f measured.awk FILE
BEGIN { OFS = "\t" }
/^inDegrees/ { degrees = $0 }
/^time/ { for (i = 1; i <= NF; i++) at[$i] = i; head = $0; columns = NF; on = 1; next }
on { line[++n] = $0 }
END {
  split(line[1], first); split(line[n], last)
  way = last[at["pelvis_tx"]] - first[at["pelvis_tx"]]; time = last[1]
  printf "measured\nversion=1\nnRows=%d\nnColumns=%d\n%s\nendheader\n%s\n", 3 * (n - 1), columns, degrees, head
  for (stride = 0; stride < 3; stride++)
    for (k = 1; k < n; k++) {
      $0 = line[k]
      $1 += stride * time; $at["pelvis_tx"] += stride * way; $at["pelvis_ty"] += 0.95
      print
    }
}
