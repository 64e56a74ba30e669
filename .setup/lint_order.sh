#!/usr/bin/env bash
# The folders of src/ are a pipeline: a folder never includes one to its right, and the
# program includes only public headers and its own.
set -u
order=(base model format trajectory mechanics gait objective nlp solver reader inverse stride picture report compare batch cli)
faults=0

fault() {
  echo "$1"
  faults=$((faults + 1))
}
position() {
  local i
  for i in "${!order[@]}"; do
    [ "${order[$i]}" = "$1" ] && echo "$i" && return
  done
  echo -1
}

while IFS=: read -r file line text; do
  folder=${file#src/}
  folder=${folder%%/*}
  target=$(sed -E 's/.*"([^"]*)".*/\1/' <<<"$text")
  area=${target%%/*}
  here=$(position "$folder")
  there=$(position "$area")
  if [ "$here" -lt 0 ]; then
    fault "$file:$line: folder '$folder' is not in the order: ${order[*]}"
  elif [ "$area" = ambulo ]; then
    [ -f "include/$target" ] || fault "$file:$line: no public header '$target'"
  elif [ ! -f "src/$target" ] || [ "$there" -lt 0 ]; then
    fault "$file:$line: \"$target\" is neither \"ambulo/x.h\" nor \"folder/x.h\" of src"
  elif [ "$folder" = cli ] && [ "$area" != cli ]; then
    fault "$file:$line: the program includes the private header \"$target\""
  elif [ "$there" -gt "$here" ]; then
    fault "$file:$line: $folder includes \"$target\" from a folder to its right"
  fi
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' src/*/*.c src/*/*.h)

while IFS=: read -r file line text; do
  case $text in
  *'"ambulo/'*) ;;
  *) fault "$file:$line: a public header includes a private one" ;;
  esac
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' include/ambulo/*.h)

[ "$faults" = 0 ] || echo "$faults faults in the order of folders"
[ "$faults" = 0 ]
