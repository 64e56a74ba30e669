# One stride of a measured motion, three times after each other, for records that are shorter than
# from strike to second strike of one foot: awk -F '\t' -v from=0.6 -v period=1.1445 -f stride.awk FILE
BEGIN { OFS = "\t" }
/^inDegrees/ { degrees = $0 }
/^time/ { for (i = 1; i <= NF; i++) if ($i ~ /pelvis_tx/) tx = i; head = $0; columns = NF; on = 1; next }
!on { next }
$1 >= from - 1e-9 && $1 < from + period - 1e-9 { line[n++] = $0 }
$1 >= from + period - 1e-9 && !ends { way = $tx; ends = 1 }
END {
  split(line[0], first); way -= first[tx]
  printf "stride\nversion=1\nnRows=%d\nnColumns=%d\n%s\nendheader\n%s\n", 3 * n, columns, degrees, head
  for (stride = 0; stride < 3; stride++)
    for (k = 0; k < n; k++) { $0 = line[k]; $1 = sprintf("%.4f", $1 + stride * period); $tx += stride * way; print }
}
