#!/usr/bin/env bash
# lint_hardening.sh LIBRARY.so PROGRAM SOVERSION: what was built can do what the flags of the Makefile
# ask for. Both: no stack that can be executed, no code that the loader changes, addresses read-only once
# they are filled in, all of them at the start, stacks guarded, sizes checked where they are known. The
# program stands anywhere in memory. The library has its soname, and a version on each function.
set -u
library=$1 program=$2 soversion=$3
faults=0
expect() { # TEXT COMMAND...
  local text=$1
  shift
  "$@" >/dev/null 2>&1 && return
  echo "$text"
  faults=1
}
has() { readelf "$2" "$3" 2>/dev/null | grep -qE "$1"; }
lacks() { ! has "$@"; }
command -v readelf >/dev/null || { echo 'skipped: lint-hardening: no readelf'; exit 0; }

for file in "$library" "$program"; do
  expect "$file: its stack can be executed" lacks 'GNU_STACK.* RWE' -lW "$file"
  expect "$file: no RELRO" has 'GNU_RELRO' -lW "$file"
  expect "$file: addresses are looked up late (no -z now)" has 'BIND_NOW|NOW' -dW "$file"
  expect "$file: the loader changes code (TEXTREL)" lacks 'TEXTREL' -dW "$file"
  expect "$file: stacks are not guarded" has '__stack_chk_fail' -sW "$file"
  expect "$file: sizes are not checked (_FORTIFY_SOURCE)" has '__[a-z]+_chk(@|$)' -sW "$file"
done
expect "$program: it is not position-independent" has 'PIE' -dW "$program"
expect "$library: its soname is not libambulo.so.$soversion" \
  has "SONAME.*\[libambulo\.so\.${soversion//./\\.}\]" -dW "$library"
expect "$library: no symbol versions" has "Name: AMBULO_${soversion%%.*}" -VW "$library"
unversioned=$(nm -D --defined-only --with-symbol-versions "$library" | awk '$2 != "A" && $NF !~ /@@AMBULO/ { print $NF }')
[ -z "$unversioned" ] || { echo "$library: without a version: $unversioned"; faults=1; }
[ "$faults" = 0 ] && echo 'stacks, sizes, addresses, soname and versions are as they should be'
exit "$faults"
