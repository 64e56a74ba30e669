#!/usr/bin/env bash
# reproducible.sh: builds the files of this clone twice, in folders of unlike names, and compares what came
# of it byte by byte: program, both libraries, Debian packages, wheel. `make check-reproducible` calls it.
#
# The second build differs from the first in all that must not matter: folder, home, user's mask, language,
# time zone, times of the sources, number of jobs, and (by faketime, where it is there) the day. Compilers
# are asked each time: no cache. ARTEFACTS=DIR keeps both builds there. Prints "N passed, N failed".
set -u
work=${ARTEFACTS:-$(mktemp -d "${TMPDIR:-/tmp}/ambulo-reproducible-XXXXXX")} || exit 1
mkdir -p "$work"
work=$(cd "$work" && pwd)
[ -n "${ARTEFACTS:-}" ] || trap 'rm -rf "$work"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL VARIANT OUT SOURCE_DATE_EPOCH
jobs=${JOBS:-2}
export CC=${CC:-cc} CCACHE_DISABLE=${CCACHE_DISABLE-1}
export DEBFULLNAME='Builder of packages' DEBEMAIL=builder@ambulo.example
python=$PWD/build/python-venv/bin
[ -x "$python/python" ] || python=
later=
if command -v faketime >/dev/null; then later=1; else echo 'skipped without faketime: another day'; fi

copy() { # FOLDER: the files of the clone, as they are now
  mkdir -p "$1/build"
  git ls-files -z --cached --others --exclude-standard | tar --ignore-failed-read --null -T - -cf - 2>/dev/null | tar -xf - -C "$1"
  touch "$1/build/.ready-build" "$1/build/.found"
}
build() { # FOLDER JOBS
  cd "$1" || return 1
  make --no-print-directory -j"$2" CC="$CC" all || return 1
  if command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null; then
    .setup/deb.sh build build/deb || return 1
  fi
  if PATH="${python:+$python:}$PATH" python3 -c 'import cffi' 2>/dev/null; then
    PATH="${python:+$python:}$PATH" python3 src/python/package.py wheel build/libambulo.so build/wheel || return 1
  fi
}
here() { (umask 022; export LC_ALL=C TZ=UTC HOME="$work/home"; build "$1" "$jobs") >"$work/first.log" 2>&1; }
elsewhere() {
  local language
  language=$(locale -a | grep -vixE 'C|POSIX' | tail -n 1)
  find "$1" -type f -exec touch -d '2031-05-06 07:08:09' {} +
  (umask 027; export LC_ALL="${language:-C}" TZ=Asia/Kathmandu HOME="$work/another home"
    if [ -n "$later" ]; then
      export -f build; export python CC
      faketime -f +500d bash -c 'build "$@"' build "$1" $((jobs + 1))
    else
      build "$1" $((jobs + 1))
    fi) >"$work/second.log" 2>&1
}

first=$work/a second="$work/second/tree/with-a-longer-name"
mkdir -p "$work/home" "$work/another home"
copy "$first"
copy "$second"
for one in "here $first first" "elsewhere $second second"; do
  # shellcheck disable=SC2086
  set -- $one
  "$1" "$2" || { tail -n 20 "$work/$3.log"; echo '0 passed, 1 failed'; exit 1; }
done

passed=0 failed=0
same() { # FILE, below build/
  if [ -f "$second/build/$1" ] && cmp "$first/build/$1" "$second/build/$1"; then
    passed=$((passed + 1))
    echo "$(sha256sum <"$first/build/$1" | cut -c1-16)  $1"
  else
    failed=$((failed + 1))
    echo "FAILED: $1 differs"
  fi
}
cd "$first/build" || exit 1
for file in ambulo libambulo.so libambulo.a deb/*.deb wheel/*.whl; do
  if [ -f "$file" ]; then same "$file"; else echo "skipped: no ${file%/*} was made here"; fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
