#!/usr/bin/env bash
# Each public header compiles alone, as C11 and as C++17, without a warning.
set -u
cc=${CC:-cc} bad=0
case $cc in *clang*) cxx=${cc/clang/clang++} ;; *gcc*) cxx=${cc/gcc/g++} ;; *) cxx=c++ ;; esac
warnings='-Wall -Wextra -Wpedantic -Wshadow -Werror'
for header in include/ambulo/*.h include/ambulo/tools/*.h; do
  name=${header#include/}
  # shellcheck disable=SC2086
  printf '#include "%s"\n#include "%s"\nint main(void) { return 0; }\n' "$name" "$name" |
    $cc -std=c11 $warnings -Wstrict-prototypes -Iinclude -fsyntax-only -x c - ||
    { echo "$header: not C11 on its own"; bad=1; }
  # shellcheck disable=SC2086
  printf '#include "%s"\nint main() { return 0; }\n' "$name" |
    $cxx -std=c++17 $warnings -Iinclude -fsyntax-only -x c++ - ||
    { echo "$header: not C++17 on its own"; bad=1; }
done
exit $bad
