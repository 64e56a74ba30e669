#!/usr/bin/env bash
# Every src/.../<room>/<file>.c has a tests/<room>/test_<file>.c, or stands with a reason in
# tests/untested.txt ("src/folder/file.c: reason"); no line there is out of date.
set -u
list=tests/untested.txt
faults=0
fault() {
  echo "$1"
  faults=1
}
listed() { grep -sqE "^$1: .{10,}" "$list"; }

for source in src/*/*.c src/*/*/*.c; do
  folder=$(basename "$(dirname "$source")")
  test=tests/$folder/test_$(basename "$source")
  if [ -f "$test" ]; then
    ! listed "$source" || fault "$list: $source has a test now"
  else
    listed "$source" || fault "$source: no $test, and no reason in $list"
  fi
done
while IFS=: read -r source _; do
  case $source in '' | '#'*) continue ;; esac
  [ -f "$source" ] || fault "$list: $source does not exist"
done < <(cat "$list" 2>/dev/null)
exit "$faults"
