#!/usr/bin/env bash
# lint_symbols.sh LIBRARY.so LIBRARY.a: what is exported is what the public headers declare, each
# function in the version of its headers (.setup/symbols.sh); the stable ones are at most 142. No
# name leaves the archive without the prefix, nothing in it is writable (constants with addresses in
# them, which the loader fills in, are not: section .data.rel.ro).
set -u
most=142
faults=0
report() {
  [ -z "$2" ] && return
  echo "$1:"
  sed 's/^/  /' <<<"$2"
  faults=1
}
exported=$(nm -D --defined-only --with-symbol-versions "$1" | awk '$2 != "A" { print $NF }' | LC_ALL=C sort)
declared=$({ .setup/symbols.sh stable | sed 's/$/@@AMBULO_0/'; .setup/symbols.sh tools | sed 's/$/@@AMBULO_TOOLS_0/'; } |
  LC_ALL=C sort)
report "exported by $1, but not declared in include/ambulo" "$(LC_ALL=C comm -13 <(echo "$declared") <(echo "$exported"))"
report "declared in include/ambulo, but not exported" "$(LC_ALL=C comm -23 <(echo "$declared") <(echo "$exported"))"
stable=$(.setup/symbols.sh stable | wc -l)
[ "$stable" -le "$most" ] || report 'include/ambulo/*.h' "$stable stable functions; expected at most $most"

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
[ "$faults" = 0 ] && echo "$stable stable functions, $(($(wc -l <<<"$exported") - stable)) of the tools; no writable variables"
exit "$faults"
