#!/usr/bin/env bash
# What is installed beside the program, and how: `make install` and its undoing, manual pages,
# completion of three shells, find_package of CMake, Debian packages. What needs a program that is not
# here is skipped, and says so. Prints "N passed, N failed".
# Environment: OUT (build folder), CC, CFLAGS, LDFLAGS, MODE as in tests/api/run.sh.
set -u
out=$(cd "${OUT:-build}" && pwd) || exit 1
cc=${CC:-cc}
top=$(pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-package-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL VARIANT
export OPENBLAS_NUM_THREADS=1 LC_ALL=C.UTF-8
passed=0 failed=0

check() { # NAME COMMAND...: counts, and shows the output of what failed
  local name=$1
  shift
  if "$@" >"$work/log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
    tail -n 20 "$work/log" | sed 's/^/  /'
  fi
}
has() { # PROGRAM WHAT
  command -v "$1" >/dev/null 2>&1 && return
  echo "skipped without $1: $2"
  return 1
}
finish() {
  echo "$passed passed, $failed failed"
  [ "$failed" = 0 ]
  exit
}
# what was built is what gets installed: "all" counts as made
make_() { make --no-print-directory -o all OUT="$out" CC="$cc" "$@"; }

# ------------------------------------------------------ install and uninstall

root=$work/root prefix=/opt/ambulo
share=$root$prefix/share

check 'make install' make_ install DESTDIR="$root" PREFIX=$prefix
[ -x "$root$prefix/bin/ambulo" ] || finish
tree() { (cd "$1" && find . | LC_ALL=C sort); }
every_file_is_listed() {
  diff <(cd "$root" && find . ! -type d | sed 's/^\.//' | LC_ALL=C sort) \
    <({ sed -n 's/^file\t//p' "$share/ambulo/manifest"; echo $prefix/share/ambulo/manifest; } | LC_ALL=C sort)
}
check 'the manifest lists every file, once' every_file_is_listed
check 'modes are those of files that all may read' test -z "$(find "$root" -type f ! -perm -444)"
check 'licence, pages and models come along' ls "$share/doc/ambulo/LICENSE" \
  "$share/doc/ambulo/docs/problem-format.md" "$share/doc/ambulo/README.md" \
  "$share/ambulo/models/norms/young_adults.csv"
finds_its_models() {
  mkdir "$work/empty"
  (cd "$work/empty" && "$root$prefix/bin/ambulo" solve pendulum_swing -o swing) 2>&1 |
    grep -F "using the shipped $share/ambulo/models/pendulum_swing.yaml"
}
check 'the installed program solves a shipped problem by its name' finds_its_models

again() { # an older release had one file more; its folder was there before
  tree "$root" >"$work/before"
  mkdir -p "$share/ambulo/old" && echo x >"$share/ambulo/old/x"
  printf 'folder\t%s\nfile\t%s\n' $prefix/share/ambulo/old $prefix/share/ambulo/old/x >>"$share/ambulo/manifest"
  make_ install DESTDIR="$root" PREFIX=$prefix || return 1
  [ ! -e "$share/ambulo/old/x" ] || { echo 'a file of the older release stayed'; return 1; }
  rmdir "$share/ambulo/old"
  diff "$work/before" <(tree "$root")
}
check 'an install over an earlier one leaves what is new' again
strangers_stay() {
  echo mine >"$share/ambulo/models/mine.yaml"
  make_ uninstall DESTDIR="$root" PREFIX=$prefix || return 1
  [ "$(tree "$root" | tail -n 1)" = ".$prefix/share/ambulo/models/mine.yaml" ] || { tree "$root"; return 1; }
  [ "$(find "$root" -type f | wc -l)" = 1 ]
}
check 'uninstall leaves what it did not write' strangers_stay
check 'uninstall without an install says so' sh -c "! make -o all uninstall DESTDIR=$root PREFIX=$prefix"
whole_circle() {
  rm -rf "$root" && mkdir -p "$root/opt" && make_ install DESTDIR="$root" PREFIX=$prefix || return 1
  make_ uninstall DESTDIR="$root" PREFIX=$prefix || return 1
  [ "$(tree "$root" | tr '\n' ' ')" = '. ./opt ' ] || { tree "$root"; return 1; }
}
check 'install and uninstall leave the tree as it was' whole_circle
check 'make install' make_ install DESTDIR="$root" PREFIX=$prefix

# ------------------------------------------------------------------- manual

commands=$("$out/ambulo" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
pages() { ls "$share"/man/man*/*; }
a_page_each() {
  local command option page
  [ -n "$commands" ] || return 1
  for command in $commands; do
    page=$share/man/man1/ambulo-$command.1
    grep -q "^.BR ambulo.-$command (1)" "$share/man/man1/ambulo.1" || { echo "$command"; return 1; }
    for option in $("$out/ambulo" "$command" --help | sed -n 's/^  *\(-., \)\{0,1\}--\([a-z-]*\).*/\2/p'); do
      sed 's/\\f[A-Z]//g; s/\\//g' "$page" | grep -q -e "--$option\b" || { echo "$command --$option"; return 1; }
    done
  done
}
check 'every command has a page with every option' a_page_each
keys_stand_in_the_manual() { # of the shipped walk
  local key
  for key in $(sed -n 's/^\([a-z_]*\):.*/\1/p' models/walk.yaml); do
    grep -q "^.fB$key.fR" "$share/man/man5/ambulo-problem.5" || { echo "no item $key"; return 1; }
  done
}
check 'ambulo-problem(5) has the keys of walk.yaml' keys_stand_in_the_manual
if has mandoc 'man pages, linted'; then
  lint() { local page bad=0; for page in $(pages); do mandoc -T lint -W warning "$page" || bad=1; done; return $bad; }
  check 'mandoc: no warning' lint
fi
if has man 'man pages, formatted'; then
  format() {
    local page text
    for page in $(pages); do
      text=$(man --warnings -E UTF-8 -l "$page" 2>&1 >/dev/null) || { echo "$page"; return 1; }
      [ -z "$text" ] || { echo "$page: $text"; return 1; }
    done
  }
  check 'man --warnings: none' format
fi
same_release() { # version and date wherever they are written
  local version day
  version=$(sed -n 's/.*VERSION_STRING "\(.*\)"/\1/p' include/ambulo/ambulo.h)
  day=$(sed -n '1s/^.TH [A-Z]* 1 \([0-9-]*\) .*/\1/p' "$share/man/man1/ambulo.1")
  grep -qx "version: $version" CITATION.cff && grep -qx "date-released: $day" CITATION.cff &&
    grep -q "\"ambulo $version\"" "$share/man/man5/ambulo-model.5" &&
    grep -qx "Version: $version" "$root$prefix/lib/pkgconfig/ambulo.pc"
}
check 'CITATION.cff, manual and header are of one release' same_release

# ------------------------------------------------------------ the interface

# what lint-abi says to a header that COMMAND changed, in a release that may not break programs
verdict_on() { # COMMAND HEADER
  rm -rf "$work/include"
  cp -R include "$work/include"
  sed -i.bak "$1" "$work/include/ambulo/$2" && ! cmp -s "$work/include/ambulo/$2" "include/ambulo/$2" || return 2
  ABI_BASE=$work/1.0.0.txt ABI_NEXT=1.1.0 ABI_INCLUDE=$work/include .setup/lint_abi.sh
}
breaks() { verdict_on "$1" "$2" | tee /dev/stderr | grep -q '^programs of 1.0.0 break: 1 lines'; }
if has readelf 'the interface against an older one' && [ "$(getconf LONG_BIT)" = 64 ]; then
  check 'the interface is printed' sh -c ".setup/lint_abi.sh print >'$work/1.0.0.txt' && grep -q '^function' '$work/1.0.0.txt'"
  check 'an argument more breaks programs' breaks 's/is_solution(ambulo_verdict verdict)/is_solution(ambulo_verdict verdict, int x)/' solve.h
  check 'a function of another name breaks programs' breaks 's/ambulo_verdict_is_solution(/ambulo_verdict_is_one(/' solve.h
  check 'a member of another type breaks programs' breaks 's/^  int maximum_evaluations;/  float maximum_evaluations;/' solve.h
  check 'a structure without a size must not grow' breaks 's/^} ambulo_progress;/  double more;\n} ambulo_progress;/' solve.h
  check 'a structure with a size may' verdict_on 's/^} ambulo_options;/  double more;\n} ambulo_options;/' solve.h
fi

# --------------------------------------------------------------- completion

completion=$share/bash-completion/completions/ambulo
# complete "ambulo solve --re": what bash offers for the last word
offers() {
  (cd "$work/files" && PATH=$root$prefix/bin:$PATH bash -c '. "$1"; shift
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _ambulo; printf "%s\n" "${COMPREPLY[@]}"' \
    complete "$completion" "$@" | LC_ALL=C sort | tr '\n' ' ')
}
expect() { # EXPECTED WORDS...
  local expected=$1 got
  shift
  got=$(offers "$@")
  [ "$got" = "$expected" ] || { echo "$*: got '$got', expected '$expected'"; return 1; }
}
mkdir -p "$work/files/a folder"
touch "$work/files/my walk.yaml" "$work/files/other.csv"
check 'bash: commands' expect 'collect compare ' ambulo co
check 'bash: options' expect '--repeat ' ambulo solve x --rep
check 'bash: choices of a value' expect 'mirrored periodic ' ambulo solve x --repeat ''
check 'bash: a choice or a file' expect 'a folder my walk.yaml other.csv zero ' \
  ambulo solve x --start ''
check 'bash: folders alone' expect 'a folder ' ambulo solve x -o ''
check 'bash: shipped names beside files' expect 'walk_start walk_stop ' ambulo solve walk_st
check 'bash: a file with a blank' expect 'my walk.yaml ' ambulo solve my
check 'bash: kinds of new' expect 'jump ' ambulo new ju
check 'bash: kinds of models' expect 'sweep ' ambulo models sw
check 'bash: every command after help' expect 'solve ' ambulo help so
check 'bash: how a root hangs' expect 'fixed free ' ambulo import robot.urdf --root ''
check 'bash: options of import' expect '--heel --help ' ambulo import robot.urdf --he
check 'bash: files to import' expect 'a folder my walk.yaml other.csv ' ambulo import ''
check 'bash: a motion for the page' expect 'my walk.yaml ' ambulo report 'a folder' --motion my
check 'bash: folders to report' expect 'a folder ' ambulo report ''
check 'bash: the script is sound' bash -n "$completion"
if has zsh 'its completion'; then
  check 'zsh: the script is sound' zsh -n "$share/zsh/site-functions/_ambulo"
  # the system of completion takes the file as that of the command
  check 'zsh: it is found' zsh -f -c "fpath=($share/zsh/site-functions \$fpath); autoload -Uz compinit &&
    compinit -u -d $work/zcompdump && [[ \$_comps[ambulo] = _ambulo ]]"
fi
if has fish 'its completion'; then
  fish_offers() {
    HOME=$work PATH=$root$prefix/bin:$PATH fish --no-config -c \
      "source $share/fish/vendor_completions.d/ambulo.fish; complete -C'$1'" | grep -q "^$2"
  }
  check 'fish: the script is sound' fish --no-execute "$share/fish/vendor_completions.d/ambulo.fish"
  check 'fish: commands' fish_offers 'ambulo inv' inverse
  check 'fish: options' fish_offers 'ambulo solve x --rep' --repeat
  check 'fish: shipped names' fish_offers 'ambulo solve walk_sto' walk_stop
fi

# -------------------------------------------------------------------- CMake

case ${MODE:-} in *-fsanitize=*) sanitized=1 ;; *) sanitized= ;; esac
if [ -n "$sanitized" ]; then
  echo 'skipped with sanitizers: find_package and Debian packages'
elif has cmake 'find_package'; then
  mkdir "$work/project"
  cat >"$work/project/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.10)
project(walker C)
find_package(ambulo ${WANTED} REQUIRED)
add_executable(shared main.c)
target_link_libraries(shared ambulo::ambulo)
add_executable(static main.c)
target_link_libraries(static ambulo::ambulo_static)
END
  sed -n '/^```c$/,/^```$/p' README.md | sed '1d;/^```$/,$d' >"$work/project/main.c"
  configure() { # FOLDER VERSION
    cmake -S "$work/project" -B "$work/$1" -DCMAKE_C_COMPILER="$(command -v "${cc%% *}")" -DWANTED="$2" \
      -DCMAKE_PREFIX_PATH="$root$prefix" -DCMAKE_C_FLAGS="${MODE:-}"
  }
  runs() { "$1" | tee /dev/stderr | grep -q '^feasible, .*objective [0-9.]'; }
  version=$("$out/ambulo" --version | sed -n '1s/ambulo //p')
  check 'find_package' configure cmake "$version"
  check 'programs of a CMake project are built' cmake --build "$work/cmake"
  check 'with the shared library' runs "$work/cmake/shared"
  check 'with the static library' runs "$work/cmake/static"
  check 'a newer version is not found' sh -c "! (cd '$top' && cmake -S '$work/project' -B '$work/newer' \
    -DWANTED=99.0 -DCMAKE_PREFIX_PATH='$root$prefix')"
fi

# --------------------------------------------------------------------- book

if has pandoc 'the book'; then
  check 'the book' .setup/book.sh "${out#"$top"/}/book/test.html"
  book=$out/book/test.html
  links_lead_within() { # each to a heading, a page or the web; no picture is outside
    grep -oE ' id="[^"]*"' "$book" | sed 's/ id="\(.*\)"/#\1/' | sort -u >"$work/ids"
    ! grep -oE 'href="[^"]*"' "$book" | sed 's/href="\(.*\)"/\1/' | grep -vE '^https?:' | sort -u |
      comm -23 - "$work/ids" | grep . && ! grep -o '<img src="[^d][^"]*"' "$book"
  }
  every_page_is_bound() {
    diff <(ls docs/*.md | sed 's/docs.//' | sort) <(sed -n 's/^<section id="\(.*\)">/\1/p' "$book" | sort)
  }
  check 'its links lead to what is there' links_lead_within
  check 'every page of docs is in it' every_page_is_bound
  rm -f "$book"
fi

# ----------------------------------------------------------------- packages

if [ -z "$sanitized" ] && has dpkg-deb 'Debian packages' && has dpkg-shlibdeps 'Debian packages'; then
  export DEBFULLNAME='Builder of packages' DEBEMAIL=builder@ambulo.example
  check 'Debian packages' .setup/deb.sh "$out" "$work/deb"
  together() { # what they hold is what make install writes
    local package
    for package in "$work"/deb/*.deb; do dpkg-deb -x "$package" "$work/unpacked" || return 1; done
    gzip -d "$work"/unpacked/usr/share/man/man*/*.gz
    diff <(cd "$work/unpacked/usr" && find . ! -type d | sed 's|lib/[^/]*-[^/]*/|lib/|; s|zsh/vendor-completions|zsh/site-functions|' |
      grep -v 'doc/[^/]*/\(copyright\|changelog.gz\|sbom.cdx.json\)$' | LC_ALL=C sort) \
      <(cd "$root$prefix" && find . ! -type d ! -name manifest ! -path ./share/doc/ambulo/LICENSE | LC_ALL=C sort)
  }
  check 'the packages hold what make install writes, each file once' together
  check 'zsh of Debian finds its completion' test -f "$work/unpacked/usr/share/zsh/vendor-completions/_ambulo"
  links_with_its_packages() { # a package for each library that the static one is linked with
    local libraries needs
    libraries=$(sed -n 's/^Libs.private: //p' "$root$prefix/lib/pkgconfig/ambulo.pc" | tr ' ' '\n' |
      grep '^-l' | grep -vxe -lm -e -lpthread | sort -u)
    needs=$(dpkg-deb -f "$work"/deb/libambulo-dev_*.deb Depends | tr ',' '\n' | grep -e '-dev')
    echo "$libraries" "$needs"
    [ "$(wc -l <<<"$libraries")" = "$(wc -l <<<"$needs")" ]
  }
  check 'the package of headers asks for what the static library needs' links_with_its_packages
  if has python3 'the list of what is linked and bundled'; then
    lists_what_it_links() { # each library that the program asks for, and the packages of the page
      local bill name
      bill=$work/unpacked/usr/share/doc/ambulo/sbom.cdx.json
      for name in nlopt libyaml three uplot fflate; do grep -q "\"name\": \"$name\"" "$bill" || { echo "no $name"; return 1; }; done
      cmp "$bill" <(.setup/sbom.py "$out/ambulo")
    }
    unknown_is_refused() { # without its entry, NLopt is a library of no known licence
      mkdir -p "$work/bill/.setup" && cp -R include "$work/bill" || return 2
      sed '/"libnlopt":/d' .setup/sbom.py >"$work/bill/.setup/sbom.py"
      ! python3 "$work/bill/.setup/sbom.py" "$out/ambulo" >"$work/said" 2>&1 && grep 'no licence is known' "$work/said"
    }
    check 'the list of what is linked and bundled' lists_what_it_links
    check 'a library without a known licence is refused' unknown_is_refused
  fi
  from_package() {
    mkdir "$work/elsewhere"
    (cd "$work/elsewhere" && "$work/unpacked/usr/bin/ambulo" solve pendulum_swing -q -o swing)
  }
  check 'the program of the package solves' from_package
  alike() { # the same build gives the same bytes
    .setup/deb.sh "$out" "$work/again" && diff -r "$work/deb" "$work/again"
  }
  check 'packages are reproducible' alike
  if has lintian 'Debian packages, linted'; then
    check 'lintian: neither error nor warning' lintian --allow-root --fail-on error,warning "$work"/deb/*.deb
  fi
fi
finish
