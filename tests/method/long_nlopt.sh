#!/usr/bin/env bash
# The mirror (src/engine/method/mirror.h) beside a newer NLopt than the installed one: NLopt is built from
# its source, and stands before the installed one (LD_PRELOAD) while test_mirror, test_auglag and a solve
# run. Skipped, with a line, where no newer source is to be had.
#
#   NLOPT_SOURCE  a source tree; without it Debian's source package (unstable), then PyPI's archive
#   OUT           build folder, with the two programs in it
set -u
out=${OUT:-build}
installed=$(pkg-config --modversion nlopt 2>/dev/null || echo 0)
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-nlopt-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
skip() {
  echo "skipped: a newer NLopt ($1)"
  echo '[  SKIPPED ]'
  exit 0
}

# its version, from CMakeLists.txt; empty where there is none
version_of() {
  sed -nE 's/^set *\(NLOPT_(MAJOR|MINOR|BUGFIX)_VERSION "?([0-9]+)"?\)/\2/p' "$1/CMakeLists.txt" 2>/dev/null |
    paste -sd .
}
is_newer() { # SOURCE
  local version
  version=$(version_of "$1")
  [ -n "$version" ] && [ "$version" != "$installed" ] &&
    [ "$(printf '%s\n' "$installed" "$version" | sort -V | tail -n 1)" = "$version" ]
}

# apt with lists of its own: the machine's are left alone
from_debian() {
  local key=/usr/share/keyrings/debian-archive-keyring.gpg apt
  command -v apt-get >/dev/null 2>&1 && [ -f "$key" ] || return 1
  mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
  echo "deb-src [signed-by=$key] http://deb.debian.org/debian unstable main" >"$work/apt/sources.list"
  apt=(timeout 120 apt-get -qq -o "Dir::Etc::SourceList=$work/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$work/apt/lists" -o "Dir::Cache=$work/apt/cache" -o APT::Sandbox::User=)
  "${apt[@]}" update && (cd "$work" && "${apt[@]}" --download-only source nlopt && mkdir debian &&
    tar xf nlopt_*.orig.tar.* --strip-components=1 -C debian) && is_newer "$work/debian" && source=$work/debian
}
from_pypi() {
  (cd "$work" && timeout 120 python3 -m pip download -q --no-deps --no-build-isolation --no-binary :all: nlopt &&
    mkdir pypi && tar xf nlopt-*.tar.gz --strip-components=1 -C pypi) || return 1
  is_newer "$work/pypi/extern/nlopt" && source=$work/pypi/extern/nlopt
}

command -v cmake >/dev/null 2>&1 || skip 'no cmake'
for program in test_mirror test_auglag; do
  [ -x "$out/tests/method/$program" ] || skip "$program is not built"
done
source=${NLOPT_SOURCE:-}
if [ -n "$source" ]; then
  [ -n "$(version_of "$source")" ] || { echo "$source is no source of NLopt"; exit 1; }
elif ! from_debian >"$work/log" 2>&1 && ! from_pypi >>"$work/log" 2>&1; then
  skip "no source newer than $installed within reach"
fi

cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DNLOPT_CXX=OFF -DNLOPT_PYTHON=OFF \
  -DNLOPT_OCTAVE=OFF -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF -DNLOPT_JAVA=OFF -DNLOPT_SWIG=OFF -DNLOPT_TESTS=OFF \
  >"$work/log" 2>&1 && cmake --build "$work/build" -j "${JOBS:-1}" >>"$work/log" 2>&1 ||
  { echo "NLopt $(version_of "$source") does not build:"; tail -n 20 "$work/log"; exit 1; }
library=$(find "$work/build" -name 'libnlopt.so' | head -n 1)
[ -n "$library" ] || { echo 'no libnlopt.so was built'; exit 1; }
echo "NLopt $(version_of "$source") in place of $installed"

status=0
for program in test_mirror test_auglag; do
  LD_PRELOAD=$library "$out/tests/method/$program" >"$work/$program" 2>&1 || status=1
  cat "$work/$program"
done
grep -qx "NLopt $(version_of "$source")" "$work/test_mirror" || { echo 'the installed NLopt ran'; status=1; }
# each row has its own gradient only where NLopt is another one
if LD_PRELOAD=$library "$out/ambulo" solve models/walk_normal.yaml -o "$work/walk" >"$work/said" 2>&1 &&
  ! grep -q 'its own gradient' "$work/said"; then
  echo '[  PASSED  ] 1 test(s).'
else
  cat "$work/said"
  echo '[  FAILED  ] 1 test(s).'
  status=1
fi
exit $status
