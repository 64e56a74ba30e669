#!/usr/bin/env bash
# old_glibc.sh BUILD FOLDER: links what was compiled in BUILD anew, into FOLDER, so that it needs no glibc
# newer than 2.28: libambulo.so, ambulo, and beside them NLopt and OpenBLAS of that age. `make wheel` packs
# these. Debian's own libraries ask for the glibc of the machine.
#
#   objects   those of BUILD, as they are: what an older glibc lacks is an error of this link
#   linker    `zig cc -target x86_64-linux-gnu.2.28` (ziglang, PyPI), which knows each glibc's symbols
#   OpenBLAS  of scipy-openblas32 (PyPI), whose names begin with scipy_
#   NLopt     the C part of Debian's sources, compiled anew; a library of its own, which may be replaced
#   libyaml, expat, zlib  their archives, within library and program
#
# PYTHON: an interpreter with ziglang and scipy-openblas32. Says what is missing, exit status 3 then.
set -eu
build=$(cd "$1" && pwd) folder=$2 python=${PYTHON:-python3}
missing() { echo "no wheel for older systems: $1" >&2; exit 3; }
[ "$(uname -sm)" = 'Linux x86_64' ] || missing 'the route is known for Linux on x86-64'
for module in ziglang scipy_openblas32; do "$python" -c "import $module" 2>/dev/null || missing "no $module (PyPI)"; done
for program in cmake apt-get objcopy; do command -v $program >/dev/null || missing "no $program"; done
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
lib=/usr/lib/x86_64-linux-gnu
for archive in yaml expat z; do [ -f $lib/lib$archive.a ] || missing "no $lib/lib$archive.a"; done
export ZIG_GLOBAL_CACHE_DIR="$folder/zig" ZIG_LOCAL_CACHE_DIR="$folder/zig"
cd "$folder"
printf '#!/bin/sh\nexec "%s" -m ziglang cc -target x86_64-linux-gnu.2.28 "$@"\n' "$(command -v "$python")" >compiler
chmod +x compiler

if [ ! -f libnlopt.so ]; then
  echo 'deb-src http://deb.debian.org/debian bookworm main' >sources.list
  mkdir -p lists/partial
  apt=(-q -o "Dir::Etc::sourcelist=$folder/sources.list" -o Dir::Etc::sourceparts=/nonexistent -o "Dir::State::lists=$folder/lists")
  apt-get "${apt[@]}" update >log 2>&1 && apt-get "${apt[@]}" source --download-only nlopt >>log 2>&1 ||
    missing 'the sources of NLopt could not be fetched'
  mkdir -p nlopt && tar xf nlopt_*.orig.tar.gz -C nlopt --strip-components 1
  cmake -S nlopt -B nlopt/build -DCMAKE_C_COMPILER="$folder/compiler" -DCMAKE_BUILD_TYPE=Release -DNLOPT_CXX=OFF \
    -DCMAKE_C_FLAGS="-ffile-prefix-map=$folder=." -DCMAKE_SKIP_RPATH=ON \
    -DNLOPT_PYTHON=OFF -DNLOPT_OCTAVE=OFF -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF -DNLOPT_SWIG=OFF -DNLOPT_TESTS=OFF >>log 2>&1
  make -C nlopt/build >>log 2>&1 || { tail -n 20 log >&2; exit 1; }
  cp -d nlopt/build/libnlopt.so* .
fi
cp "$("$python" -c 'import scipy_openblas32 as m; print(m.get_lib_dir())')/libscipy_openblas.so" .

# what expat asks for, glibc 2.36 has; by getrandom, which Linux has since 3.17
cat >random.c <<'END'
#include <stdlib.h>
#include <sys/random.h>
void arc4random_buf(void *bytes, size_t count) {
  char *at = bytes;
  while (count > 0) {
    ssize_t got = getrandom(at, count > 256 ? 256 : count, 0);
    if (got <= 0) abort();
    at += got;
    count -= (size_t)got;
  }
}
END
rm -rf cli && mkdir cli
nm -u "$build/libambulo.a" "$build"/obj/src/cli/*.o |
  awk 'NF == 2 && $2 ~ /^(d[a-z]+_|openblas_.*)$/ { print $2, "scipy_" $2 }' | sort -u >names
objcopy --redefine-syms=names "$build/libambulo.a" objects.a
for object in "$build"/obj/src/cli/*.o; do objcopy --redefine-syms=names "$object" "cli/${object##*/}"; done
soname=$(readelf -dW "$build/libambulo.so" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
common=(random.c $lib/libyaml.a $lib/libexpat.a $lib/libz.a -L. -lnlopt -lscipy_openblas -lm -lpthread
  "$(cc -print-file-name=libgcc.a)" -Wl,-z,defs -Wl,-z,relro -Wl,-z,now)
./compiler -O2 -fPIC -shared "-Wl,-soname,$soname" -Wl,--version-script="$build/obj/libambulo.map" \
  -Wl,--whole-archive objects.a -Wl,--no-whole-archive "${common[@]}" -o libambulo.so
./compiler -O2 -fPIE -pie cli/*.o objects.a "${common[@]}" -o ambulo
rm -rf cli objects.a
newest=$(objdump -T ambulo ./*.so | grep -oE 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
echo "linked for $newest"
