#!/usr/bin/env bash
# lint_order.sh OBJECTS: the rooms of src/ are a pipeline, in the order below. Levels: src/engine/ROOM
# comes first, then src/files/ROOM, then the rooms directly under src/.
#   - a room never includes a header of a later room;
#   - an object of a room (OBJECTS/.../room/file.o) never needs a symbol that a later room defines,
#     and no files need each other in a circle;
#   - a private name is declared in a header of the room that defines it;
#   - the program includes and links only public names and its own.
set -u
objects=$1
order=(base model trajectory mechanics muscle contact problem linear method solver formats definitions
  people import exchange retarget show study cli)
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
sources() { find src -name '*.c' | sort; }
headers() { find src -name '*.h' | sort; }
# the header of src that an include names
header_of() { ls "src/engine/$1" "src/files/$1" "src/$1" 2>/dev/null | head -n 1; }

# ---------------------------------------------------------------- includes

while IFS=: read -r file line text; do
  room=$(basename "$(dirname "$file")")
  target=$(sed -E 's/.*"([^"]*)".*/\1/' <<<"$text")
  area=${target%%/*}
  here=$(position "$room")
  there=$(position "$area")
  if [ "$here" -lt 0 ]; then
    fault "$file:$line: room '$room' is not in the order: ${order[*]}"
  elif [ "$area" = ambulo ]; then
    [ -f "include/$target" ] || fault "$file:$line: no public header '$target'"
  elif [ "$there" -lt 0 ] || [ -z "$(header_of "$target")" ]; then
    fault "$file:$line: \"$target\" is neither \"ambulo/x.h\" nor \"room/x.h\" of src"
  elif [ "$room" = cli ] && [ "$area" != cli ]; then
    fault "$file:$line: the program includes the private header \"$target\""
  elif [ "$there" -gt "$here" ]; then
    fault "$file:$line: $room includes \"$target\" of a later room"
  fi
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' $(sources) $(headers))

while IFS=: read -r file line text; do
  case $text in
  *'"ambulo/'*) ;;
  *) fault "$file:$line: a public header includes a private one" ;;
  esac
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' include/ambulo/*.h include/ambulo/tools/*.h)
# the engine knows none of the tools
while IFS=: read -r file line text; do
  fault "$file:$line: the engine includes a header of the tools"
done < <(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"ambulo/tools/' include/ambulo/*.h src/engine/*/*.[ch])

# ----------------------------------------------------------------- symbols

# objects of sources that are there; what an earlier build left behind does not count
present=()
while read -r object; do
  name=${object#"$objects"/}
  [ -f "src/${name%.o}.c" ] && present+=("$object")
done < <(find "$objects" -name '*.o' | sort)
for source in $(sources); do
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
  [ -n "$symbol" ] && fault "src/$user: needs $symbol of src/$definer, in a later room"
done < <(awk -v order="${order[*]}" '
  BEGIN { count = split(order, name, " "); for (i = 1; i <= count; i++) place[name[i]] = i }
  function room(path,    part, n) { n = split(path, part, "/"); return part[n - 1] }
  place[room($2)] > place[room($1)]' <<<"$arrows")

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
  fault "$header: declares $symbol, which room '$folder' defines"
done < <(nm -A -g --defined-only "${present[@]}" | sed "s#^$objects/##" |
  awk '$NF ~ /^ambulo__/ { sub(/:.*/, "", $1); n = split($1, part, "/"); print $NF, part[n - 1] }' |
  awk '
    NR == FNR { folder[$1] = $2; next }
    {
      n = split(FILENAME, part, "/")
      if ($0 ~ /^(extern )?[a-z_].*\(/ && $0 !~ /^static/ && match($0, /ambulo__[a-z0-9_]+\(/)) {
        name = substr($0, RSTART, RLENGTH - 1)
        if ((name in folder) && folder[name] != part[n - 1])
          print FILENAME, name, folder[name]
      }
    }' - $(headers))

[ "$faults" = 0 ] || echo "$faults faults in the order of rooms"
[ "$faults" = 0 ]
