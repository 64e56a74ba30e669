#!/usr/bin/env bash
# way.sh PROGRAM PROBLEM: the files of src/ and include/ that one solve enters, in the order in which it
# first enters them, with the functions entered in each, and how many. PROGRAM is built by
# `make VARIANT=way`: every function reports its first entry (tests/support/way.c).
set -eu
program=$1 problem=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
AMBULO_WAY=$work/way "$program" solve "$problem" -o "$work/out" --quiet
addr2line -f -e "$program" <"$work/way" | paste - - | sed -E "s#\t$PWD/#\t#; s#/\./#/#g; s#:[0-9?]+( \(.*)?\$##" |
  awk -F '\t' '
    $2 !~ /^(src|include)\// { next }
    !($2 in functions) { order[++files] = $2 }
    !seen[$0]++ { functions[$2]++; all++ }
    END {
      for (i = 1; i <= files; i++) printf "%4d  %s\n", functions[order[i]], order[i]
      printf "%d files, %d functions\n", files, all
    }'
