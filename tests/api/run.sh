#!/usr/bin/env bash
# The library as a stranger meets it: installed below a folder of its own, found by pkg-config,
# used by the README's C program, shared and static, from C++, and by the programs of docs/examples.
# (The commands of the pages run in tests/docs/run.sh.)
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

# each complete program, in a folder with nothing but the installed models; its last lines, and
# what they have to say
top=$PWD
mkdir "$work/examples"
cp -r "$work/root/usr/share/ambulo/models" "$work/examples/models"
# bodies in threads: a coarser grid, since the twelve solves are compared with each other alone
sed -i 's/intervals: 96/intervals: 48/' "$work/examples/models/walk_without_reaction.yaml"
# shellcheck disable=SC2046,SC2086,SC2317
build_program() { $cc -std=c11 -Wall -Wextra -Wconversion -Wshadow -Werror -pthread $mode \
  "$top/docs/examples/$1.c" -o "$work/examples/$1" $(package --cflags --libs) -lm; }
# shellcheck disable=SC2317
run_program() { (cd "$work/examples" && "./$@" >"$work/said" 2>"$work/errors") ||
  { cat "$work/said" "$work/errors"; false; }; }
# shellcheck disable=SC2317
says() { grep -qE "$1" "$work/said" || { cat "$work/said"; false; }; }
# shellcheck disable=SC2317
awk_says() { awk "$1" "$work/said" || { cat "$work/said"; false; }; }

for source in docs/examples/*.c; do
  name=$(basename "$source" .c)
  check "$name: builds" build_program "$name"
  check "$name: docs/guide-c-api.md names it" grep -q "examples/$name.c" docs/guide-c-api.md
done
check 'solve_walk runs' run_program solve_walk models/walk_normal.yaml walk gait.step_width=0.12
check 'solve_walk: a solution' says '^walk_normal: feasible, and a first-order'
check 'solve_walk: a folder' test -s "$work/examples/walk/summary.json"
check 'solve_walk: no folder twice' eval '! run_program solve_walk models/walk_normal.yaml walk'
check 'inverse_motion runs' run_program inverse_motion
# noise of 2 mrad at 100 Hz is of no use without a filter
check 'inverse_motion: the filter serves' awk_says \
  '/torque off by/ { sub(/.* by /, ""); off[++n] = $1 } END { exit !(off[1] > 20 && off[2] > 0 && off[2] < 1) }'
check 'own_term runs' run_program own_term models/walk_normal.yaml
check 'own_term: right gradients' awk_says \
  '/^gradient/ { n++; if ($NF > 1e-7) bad = 1 } END { exit bad || n != 2 }'
check 'own_term: the head is up, the knees do less' awk_says \
  '{ head[$1] = $6; knees[$1] = $(NF - 1) }
   END { exit !(head["before"] < 1.75 && head["after"] > 1.75499 && knees["after"] < knees["before"]) }'
check 'own_problem runs' run_program own_problem
check 'own_problem: a swing' says '^optimal: [0-9.]* of which [0-9.]* power squared'
check 'what_it_costs runs' run_program what_it_costs models/walker_2d_step.yaml gait.step_length 0.4 1.1
check 'what_it_costs: the best is cheaper' awk_says \
  '/^best/ { better = $10 + 0 < $13 + 0 } /raises|lowers/ { words++ } END { exit !(better && words == 5) }'
check 'bodies_in_threads runs' run_program bodies_in_threads models/walk_without_reaction.yaml 1
check 'bodies_in_threads: six solutions' awk_says '/ kg .*[^n](optimal|feasible)/ { n++ } END { exit n != 6 }'
cp "$work/said" "$work/one"
check 'bodies_in_threads runs in three' run_program bodies_in_threads models/walk_without_reaction.yaml 3
check 'bodies_in_threads: the same numbers' cmp "$work/said" "$work/one"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
