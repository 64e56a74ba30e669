#!/usr/bin/env bash
# The Python package: a wheel of the built library, installed into a fresh virtual environment, and
# all tests of it there; where no such environment can be made, the package as it is put together.
# Skips with a word where there is no Python 3 with cffi and numpy; what needs pandas, matplotlib or
# a notebook's machinery skips by itself.
#
# Prints "N passed, N failed". Environment: OUT (build folder), CC, MODE as in tests/api/run.sh;
# PYTHON (python3): the interpreter. `make check-python` brings all that is optional.
set -u
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.." || exit 1
out=$(cd "${OUT:-build}" && pwd) || exit 1
python=${PYTHON:-python3}
library=$out/libambulo.so
[ -f "$library" ] || library=$out/libambulo.dylib # macOS
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-python-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
skip() {
  echo "[  SKIPPED ]"
  echo "skipped: tests/python/long.sh: $1"
  exit 0
}
export OPENBLAS_NUM_THREADS=1 MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 PYTHONWARNINGS=error::SyntaxWarning
unset PYTHONPATH MAKEFLAGS MFLAGS MAKELEVEL

case ${MODE:-} in
*-fsanitize=* | *--coverage*) skip 'the interpreter cannot load an instrumented library' ;;
esac
"$python" -c 'import cffi, numpy' 2>/dev/null || skip "no $python with cffi and numpy (make check-python brings them)"

failed=0
fail() {
  echo "FAILED: $1"
  sed 's/^/  /' "$work/log"
  failed=$((failed + 1))
}
passed=0

# the environment sees the cffi and numpy of this interpreter, and nothing else of this folder
make_environment() {
  "$python" src/python/package.py wheel "$library" "$work/wheel" &&
    "$python" -m venv "$work/venv" &&
    "$python" -c 'import site, sysconfig; print(sysconfig.get_path("purelib"), *site.getsitepackages(), sep="\n")' \
      >"$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/outer.pth" &&
    "$work/venv/bin/python" -m pip install --no-index --no-deps --disable-pip-version-check \
      "$work"/wheel/*.whl
}

if "$python" -c 'import venv, ensurepip' 2>/dev/null; then
  if make_environment >"$work/log" 2>&1; then passed=1; else fail 'a wheel in a fresh environment'; fi
  run=("$work/venv/bin/python")
else
  echo 'skipped: tests/python/long.sh: no venv: the package is tested without its wheel'
  "$python" src/python/package.py stage "$library" "$work/staged" >"$work/log" 2>&1 ||
    fail 'the package'
  run=(env "PYTHONPATH=$work/staged" "$python")
fi
if [ "$failed" != 0 ]; then
  echo "$passed passed, $failed failed"
  exit 1
fi
echo "$passed passed, 0 failed"
mkdir "$work/empty" && cd "$work/empty" || exit 1
AMBULO_TOP=$here/../.. AMBULO=$out/ambulo "${run[@]}" "$here/run_all.py" "$@"
