#!/usr/bin/env bash
# lint_symbols.sh LIBRARY.so LIBRARY.a: exported names are public ones, no name leaves the
# archive without the prefix, nothing in it is writable (constants with addresses in them,
# which the loader fills in, are not: section .data.rel.ro).
set -u
faults=0
report() {
  [ -z "$2" ] && return
  echo "$1:"
  sed 's/^/  /' <<<"$2"
  faults=1
}
exported=$(nm -D --defined-only "$1" | awk '{ print $NF }' | sed 's/@.*//')
report "exported by $1, but not ambulo_*" \
  "$(grep -vE '^(ambulo_[a-z0-9]|_init$|_fini$|_edata$|_end$|__bss_start$)' <<<"$exported")"
report "private symbols (ambulo__*) exported by $1" "$(grep '^ambulo__' <<<"$exported")"

# functions of the public headers that the library does not define
declared=$(cat include/ambulo/*.h include/ambulo/tools/*.h | tr '\n' ' ' | sed 's#/\*[^*]*\*\+\([^/*][^*]*\*\+\)*/##g' |
  grep -oE 'AMBULO_API [^;]*;' | sed -E 's/.*[ *](ambulo_[a-z0-9_]+)\(.*/\1/' | grep '^ambulo_')
report "declared in include/ambulo, but not exported" \
  "$(comm -23 <(sort -u <<<"$declared") <(sort -u <<<"$exported"))"

report "global names without the prefix in $2" \
  "$(nm -A -g --defined-only "$2" | awk '$NF !~ /^ambulo_/ { print $1, $NF }')"
report "writable variables in $2" \
  "$(objdump -t "$2" | awk '
      / file format / { object = $1 }
      $0 ~ / O / || $0 ~ /\*COM\*/ {
        for (i = 1; i <= NF; i++)
          if (($i ~ /^\.(data|bss|tdata|tbss)/ && $i !~ /^\.data\.rel\.ro/) || $i == "*COM*")
            print object, $NF
      }')"
[ "$faults" = 0 ] && echo "$(wc -l <<<"$exported") exported symbols, all ambulo_*; no writable variables"
exit "$faults"
