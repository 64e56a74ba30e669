#!/usr/bin/env bash
# symbols.sh stable|tools|map: the functions that the public headers declare, sorted; or the linker's
# version script made of them. stable: include/ambulo/*.h, the promise of ambulo/ambulo.h; tools:
# include/ambulo/tools/*.h.
set -eu
functions() {
  cat "$@" | tr '\n' ' ' | sed 's#/\*[^*]*\*\+\([^/*][^*]*\*\+\)*/##g' | grep -oE 'AMBULO_API [^;{]*;' |
    sed -E 's/^[^(]*[ *](ambulo_[a-z0-9_]+)\(.*/\1/' | grep '^ambulo_[a-z0-9_]*$' | LC_ALL=C sort -u
}
case $1 in
stable) functions include/ambulo/*.h ;;
tools) functions include/ambulo/tools/*.h ;;
map)
  echo 'AMBULO_0 {'
  echo '  global:'
  functions include/ambulo/*.h | sed 's/.*/    &;/'
  echo '  local: *;'
  echo '};'
  echo 'AMBULO_TOOLS_0 {'
  echo '  global:'
  functions include/ambulo/tools/*.h | sed 's/.*/    &;/'
  echo '} AMBULO_0;'
  ;;
esac
