#!/usr/bin/env bash
# cross.sh aarch64|musl: compiles every object of the library and the program for another machine or
# another C library, into build/cross-NAME, with all warnings as errors; `make cross-objects` does both.
# With SYSROOT, a folder that has the libraries for that machine (usr/lib, usr/include), the library
# and the program are linked, too. Debian: apt-get install gcc-aarch64-linux-gnu musl-tools.
set -eu
name=$1
case $name in
aarch64) compiler=aarch64-linux-gnu-gcc ;;
musl) compiler=musl-gcc ;;
*) echo "cross.sh: '$name'; expected aarch64 or musl" >&2; exit 2 ;;
esac
command -v $compiler >/dev/null || { echo "skipped: no $compiler"; exit 0; }
out=build/cross-$name
include=$PWD/$out/include
mkdir -p "$include"
if [ -n "${SYSROOT:-}" ]; then
  find "$SYSROOT/usr/include" \( -name nlopt.h -o -name yaml.h \) -exec ln -sf {} "$include/" \;
  lib=$(dirname "$(find "$SYSROOT/usr/lib" -name libyaml.so | head -n 1)")
  blas=$(dirname "$(find "$SYSROOT/usr/lib" -name 'libopenblas.so' | head -n 1)")
  set -- all "LDFLAGS=-L$lib -L$blas -Wl,-rpath-link,$lib:$blas" "LIBS=-lnlopt -lyaml -lopenblas -lm -lpthread"
else
  # the two headers say the same on every machine
  for header in nlopt.h yaml.h; do ln -sf "/usr/include/$header" "$include/"; done
  set -- objects
fi
make --no-print-directory -j"${JOBS:-2}" OUT=$out CC=$compiler CPPFLAGS="-I$include" PKG_CONFIG=false "$@"
echo "$name: $(find $out/obj/src -name '*.o' | wc -l) objects by $($compiler -dumpmachine) $($compiler -dumpversion)"
