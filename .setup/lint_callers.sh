#!/usr/bin/env bash
# lint_callers.sh OBJECTS: private functions and tables (ambulo__*) of src that no other object
# refers to and that their own file does not use either: what only tests call, or nobody. It goes,
# or moves to tests/support where it is the independent way to the same numbers.
# OBJECTS: the folder with the objects of src.
set -u
export LC_ALL=C
faults=0
fault() {
  echo "  $1: $2 is called by nobody in src"
  faults=1
}
symbols=$(for source in src/*/*.c src/*/*/*.c; do
  object=${source#src/}
  echo "$1/${object%.c}.o"
done | xargs nm -A -g)
needed=$(awk '$(NF-1) == "U" { print $NF }' <<<"$symbols" | sort -u)
defined=$(awk -v objects="$1/" '$(NF-1) != "U" && $NF ~ /^ambulo__/ {
  sub(/\.o:.*/, ".c", $1); print $NF, "src/" substr($1, length(objects) + 1) }' <<<"$symbols" |
  sort -u)
while read -r name source; do
  # inlined calls leave no symbol behind: they are indented, definitions start their line
  grep -E '^[[:space:]#]' "$source" | grep -v '^ \*' | grep -qw "$name" || fault "$source" "$name"
done < <(join -v 1 <(echo "$defined") <(echo "$needed"))

# functions in headers: their definition is not enough
words=$(cat src/*/*.[ch] src/*/*/*.[ch] | grep -v '^ \*' | grep -oE 'ambulo__[a-z0-9_]+' | sort | uniq -d)
while read -r name header; do
  fault "$header" "$name"
done < <(grep -oE '^static inline [^(]*\(' src/*/*.h src/*/*/*.h |
  sed -nE 's/^([^:]*):static inline .*[ *](ambulo__[a-z0-9_]+)\($/\2 \1/p' | sort -u |
  join -v 1 - <(echo "$words"))
exit "$faults"
