#!/usr/bin/env bash
# coverage.sh BUILD: line coverage of src/ after a test run of a --coverage build, by folder.
set -u
find "$1/obj/src" -name '*.gcda' | sort | while read -r data; do
  gcov -n -o "$data" "$data" 2>/dev/null
done | awk -F"[':% ]+" '
  /^File / { file = $2; next }
  /^Lines executed/ && file ~ /^src\/[a-z]+\/[a-z0-9_]+\.[ch]$/ {
    split(file, part, "/")
    if (file in seen) next
    seen[file] = 1
    lines[part[2]] += $NF
    hit[part[2]] += $NF * $3 / 100
    if ($3 < 80) low = low sprintf("  %s %.0f%% of %d lines\n", file, $3, $NF)
  }
  END {
    for (folder in lines) {
      printf "%-12s %5.1f%% of %d lines\n", folder, 100 * hit[folder] / lines[folder], lines[folder]
      all += lines[folder]; good += hit[folder]
    }
    if (all) printf "%-12s %5.1f%% of %d lines\n", "all", 100 * good / all, all
    if (low) printf "below 80%%:\n%s", low
  }'
