#!/usr/bin/env bash
# lint_order.sh OBJECTS: the folders of src/ are a pipeline.
#   - a folder never includes a header of one to its right;
#   - an object of a folder (OBJECTS/folder/file.o) never needs a symbol that one to its right
#     defines, nor do files need each other in a circle;
#   - a private name is declared in a header of the folder that defines it;
#   - the program includes and links only public names and its own.
set -u
objects=$1
order=(base model format trajectory mechanics gait device objective nlp linear method judge solver sensitivity reader import outer
  inverse export stride compare picture scene report front sweep batch collect fit page cli)
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

# ---------------------------------------------------------------- includes

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

# ----------------------------------------------------------------- symbols

# objects of sources that are there; what an earlier build left behind does not count
present=()
for object in "$objects"/*/*.o; do
  name=${object#"$objects"/}
  [ -f "src/${name%.o}.c" ] && present+=("$object")
done
for source in src/*/*.c; do
  name=${source#src/}
  case $name in *_avx*) continue ;; esac # not on every machine
  [ -f "$objects/${name%.c}.o" ] || fault "$source: no object in $objects; build first"
done

# arrows: "user.c definer.c symbol", of different files
arrows=$(nm -A -g "${present[@]}" | sed "s#^$objects/##" | awk '
  { split($1, part, ":"); file = part[1]; sub(/\.o$/, ".c", file); kind = $(NF - 1); name = $NF }
  kind ~ /^[Uwv]$/ { user[++uses] = file; used[uses] = name; next }
  { definer[name] = file }
  END {
    for (i = 1; i <= uses; i++)
      if (used[i] in definer && definer[used[i]] != user[i])
        print user[i], definer[used[i]], used[i]
  }' | sort)
[ -n "$arrows" ] || fault "no symbol passes between the objects of $objects"

while read -r user definer symbol; do
  [ -n "$symbol" ] && fault "src/$user: needs $symbol of src/$definer, in a folder to its right"
done < <(awk -v order="${order[*]}" '
  BEGIN { count = split(order, name, " "); for (i = 1; i <= count; i++) place[name[i]] = i }
  { split($1, a, "/"); split($2, b, "/") }
  place[b[1]] > place[a[1]]' <<<"$arrows")

while read -r user definer symbol; do
  [ -n "$symbol" ] && fault "src/$user: the program needs the private $symbol of src/$definer"
done < <(grep -E '^cli/[^ ]* ' <<<"$arrows" | grep -E ' ambulo__' | grep -vE '^[^ ]* cli/')

# circles: files of which every one needs, directly or not, every other
while read -r circle; do
  fault "circle: $circle"
done < <(awk '
  !(($1, $2) in seen) { seen[$1, $2] = 1; next_of[$1] = next_of[$1] " " $2; node[$1]; node[$2] }
  # Tarjan
  function visit(v,    targets, count, k, w, members, size) {
    index_of[v] = low[v] = ++visits
    stack[++depth] = v
    on_stack[v] = 1
    count = split(next_of[v], targets, " ")
    for (k = 1; k <= count; k++) {
      w = targets[k]
      if (!(w in index_of)) {
        visit(w)
        if (low[w] < low[v]) low[v] = low[w]
      } else if (on_stack[w] && index_of[w] < low[v]) low[v] = index_of[w]
    }
    if (low[v] != index_of[v]) return
    size = 0
    do {
      w = stack[depth--]
      on_stack[w] = 0
      members = members " src/" w
      size++
    } while (w != v)
    if (size > 1) print substr(members, 2)
  }
  END { for (v in node) if (!(v in index_of)) visit(v) }' <<<"$arrows" | sort)

# private names: declared where they are defined
while read -r header symbol folder; do
  fault "$header: declares $symbol, which folder '$folder' defines"
done < <(nm -A -g --defined-only "${present[@]}" | sed "s#^$objects/##" |
  awk '$NF ~ /^ambulo__/ { split($1, part, "/"); print $NF, part[1] }' |
  awk '
    NR == FNR { folder[$1] = $2; next }
    {
      split(FILENAME, part, "/")
      if ($0 ~ /^(extern )?[a-z_].*\(/ && $0 !~ /^static/ && match($0, /ambulo__[a-z0-9_]+\(/)) {
        name = substr($0, RSTART, RLENGTH - 1)
        if ((name in folder) && folder[name] != part[2])
          print FILENAME, name, folder[name]
      }
    }' - src/*/*.h)

[ "$faults" = 0 ] || echo "$faults faults in the order of folders"
[ "$faults" = 0 ]
