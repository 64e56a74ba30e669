#!/usr/bin/env bash
# The library as a stranger meets it: installed below a folder of its own, found by pkg-config,
# used by the README's C program and from C++; the README's shell lines run as they stand.
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

# one shell line of the README; files that it writes go to a scratch folder
# shellcheck disable=SC2317
run_line() {
  (cd "$work/shell" && PATH=$work/root/usr/bin:$PATH && eval "$1")
}

# each command of the overview has a row in docs/cli.md
# shellcheck disable=SC2317
commands_documented() {
  local command lost=0
  for command in $(ambulo --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    grep -q "^| \`ambulo $command " docs/cli.md || { echo "no row for $command"; lost=1; }
  done
  [ -n "$command" ] && return $lost
}

# every key of summary.json (but the names of terms and feet) stands in docs/results.md
# shellcheck disable=SC2317
keys_documented() {
  local key lost=0
  for key in $(sed '/"terms": {/,/}/d; /"\(left\|right\)": {/d' "$1" | grep -oE '"[a-z_]+":' | tr -d '":' | sort -u); do
    grep -qE "\`[^\`]*\b$key\b[^\`]*\`" docs/results.md ||
      { echo "docs/results.md has no word about '$key'"; lost=1; }
  done
  [ -s "$1" ] && return $lost
}

# and so does every kind of column of motion.csv
# shellcheck disable=SC2317
columns_documented() {
  local kind lost=0
  for kind in $(grep -v '^#' "$1" | head -n 1 | tr ',' '\n' | sed 's/\..*//' | sort -u); do
    grep -qE "^\| \`$kind[.\`]" docs/results.md ||
      { echo "docs/results.md has no row for the columns '$kind'"; lost=1; }
  done
  [ -s "$1" ] && return $lost
}

# the map in the README names the folders of src, all of them
# shellcheck disable=SC2016,SC2317
map_is_true() {
  diff <(sed -n '/^| folder/,/^$/s/^| `\([a-z]*\)`.*/\1/p' README.md | sort) \
    <(find src -mindepth 1 -maxdepth 1 -type d -exec basename {} \; | sort)
}
# no link of a page leads nowhere
# shellcheck disable=SC2317
links_lead_somewhere() {
  local page target lost=0
  for page in README.md CHANGELOG.md docs/*.md; do
    while read -r target; do
      [ -e "$(dirname "$page")/$target" ] || { echo "$page: no $target"; lost=1; }
    done < <(grep -oE '\]\([^)#]+\)' "$page" | sed 's/^](//; s/)$//' | grep -v '^https\?:')
  done
  return $lost
}

check 'README: map of src' map_is_true
# shellcheck disable=SC2317
pages_are_linked() {
  local page lost=0
  for page in docs/*.md; do
    grep -q "]($page)" README.md || { echo "README.md does not lead to $page"; lost=1; }
  done
  return $lost
}

check 'README leads to every page' pages_are_linked
check 'links of the pages' links_lead_somewhere
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

# the programs of the guide
# shellcheck disable=SC2016
awk -v dir="$work" '/^```c$/ { file = dir "/guide" ++n ".c"; next } /^```$/ { file = "" }
  file { print > file }' docs/guide-c-api.md
# shellcheck disable=SC2046,SC2086,SC2317
guide_program() {
  $cc -std=c11 -Wall -Wextra -Werror $mode "$1" -o "${1%.c}" $(package --cflags --libs) && "${1%.c}"
}
check 'the guide has programs' test -s "$work/guide3.c"
for program in "$work"/guide*.c; do
  check "docs/guide-c-api.md: ${program##*/}" guide_program "$program"
done

# the complete examples of the format pages, among the installed models
yaml_block() { sed -n '/^```yaml$/,/^```$/p' "$1" | sed '1d;/^```$/,$d'; }
models=$work/root/usr/share/ambulo/models
yaml_block docs/model-format.md >"$models/example_model.yaml"
yaml_block docs/problem-format.md >"$models/example_problem.yaml"
check 'docs/model-format.md: example' "$work/root/usr/bin/ambulo" info "$models/example_model.yaml"
check 'docs/problem-format.md: example' \
  "$work/root/usr/bin/ambulo" check "$models/example_problem.yaml"

PATH=$work/root/usr/bin:$PATH check 'docs/cli.md: commands' commands_documented

mkdir "$work/shell"
ln -s "$PWD/models" "$work/shell/models"
while IFS= read -r line; do
  case $line in ambulo*) check "README: $line" run_line "$line" ;; esac
done < <(block sh)
check 'keys of summary.json are documented' keys_documented "$work/shell/walk/summary.json"
check 'a walk with ground reaction' \
  run_line 'ambulo solve models/walk_normal.yaml -o grounded --quiet'
check 'its keys are documented' keys_documented "$work/shell/grounded/summary.json"
check 'its columns are documented' columns_documented "$work/shell/grounded/motion.csv"
check 'columns of motion.csv are documented' columns_documented "$work/shell/walk/motion.csv"

echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
