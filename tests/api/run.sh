#!/usr/bin/env bash
# The library as a stranger meets it: installed below a folder of its own, found by pkg-config,
# used by the README's C program, shared and static, and from C++. (The commands of the pages run in
# tests/docs/run.sh.)
# Prints "N passed, N failed". Environment: OUT (build folder), CC, CFLAGS, LDFLAGS as in the build,
# MODE (compiler flags of the variant, such as sanitizers).
set -u
out=${OUT:-build}
cc=${CC:-cc} mode="${MODE:-} ${CFLAGS:-} ${LDFLAGS:-}"
case $cc in *clang*) cxx=${cc/clang/clang++} ;; *gcc*) cxx=${cc/gcc/g++} ;; *) cxx=c++ ;; esac
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL
export OPENBLAS_NUM_THREADS=1
passed=0 failed=0

# check NAME COMMAND...: counts, and shows the output of what failed
check() {
  local name=$1
  shift
  if "$@" >"$work/log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
    sed 's/^/  /' "$work/log"
  fi
}

# the first code block of a language in the README
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" README.md | sed '1d;/^```$/,$d'; }

package() {
  PKG_CONFIG_SYSROOT_DIR=$work/root PKG_CONFIG_PATH=$work/root/usr/lib/pkgconfig \
    PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 pkg-config "$@" ambulo
}

# shellcheck disable=SC2046,SC2086,SC2317
build_shared() { $cc -std=c11 -Wall -Wextra -Werror $mode "$work/example.c" -o "$work/shared" \
  $(package --cflags --libs); }
# shellcheck disable=SC2046,SC2086,SC2317
build_static() { $cc -std=c11 -Wall -Wextra -Werror $mode "$work/example.c" -o "$work/static" \
  $(package --cflags) "$work/root/usr/lib/libambulo.a" \
  $(package --static --libs | sed 's/-lambulo//'); }
# shellcheck disable=SC2046,SC2086,SC2317
build_cpp() {
  printf '%s\n' '#include <ambulo/ambulo.h>' '#include <cstring>' \
    'int main() { return std::strcmp(ambulo_version(), AMBULO_VERSION_STRING); }' >"$work/x.cc"
  $cxx -std=c++17 -Wall -Wextra -Werror $mode "$work/x.cc" -o "$work/cpp" \
    $(package --cflags --libs)
}
# the program says that every row holds
# shellcheck disable=SC2317
run_example() { "$1" | tee /dev/stderr | grep -q '^feasible, .*objective [0-9.]'; }
# shellcheck disable=SC2317
linked_to_library() { ldd "$work/shared" | grep -q "$work/root/usr/lib/libambulo.so"; }

# what was built is what gets installed: "all" counts as made
check 'make install' make --no-print-directory -o all OUT="$out" CC="$cc" install \
  DESTDIR="$work/root" PREFIX=/usr
if [ ! -f "$work/root/usr/lib/pkgconfig/ambulo.pc" ]; then
  echo "$passed passed, $failed failed"
  exit 1
fi
export LD_LIBRARY_PATH=$work/root/usr/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}

block c >"$work/example.c"
check 'README has a C program' test -s "$work/example.c"
check 'C program, shared library' build_shared
check 'shared library is the one installed' linked_to_library
check 'C program runs, shared' run_example "$work/shared"
check 'C program, static library' build_static
check 'C program runs, static' run_example "$work/static"
check 'use from C++' build_cpp
check 'C++ program runs' "$work/cpp"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
