#!/usr/bin/env bash
# lint_abi.sh [print]: the stable interface (include/ambulo/*.h) against that of the last
# release, .setup/abi/VERSION.txt. A program that was built with that release and runs with this library
# breaks where
#   - a function is gone, or has other arguments;
#   - a member has another place, size or type, or is gone; a constant has another value;
#   - a structure without a size has another one; a new member lies in the padding of the older structure.
# Then the number that CHANGELOG.md gives to the next release must be another major one (in 0.x: another
# minor one), which is that of the soname; else this fails.
#
# print writes the interface of these headers, as the compiler lays it out: what a release commits as
# .setup/abi/VERSION.txt. Read from the debugging information of one object; skips without readelf.
# Environment: CC; ABI_INCLUDE, ABI_BASE, ABI_NEXT: other headers, another file, another next version
# (tests/package).
set -u
include=${ABI_INCLUDE:-include}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cc=${CC:-cc}
command -v readelf >/dev/null || { echo 'skipped: lint-abi: no readelf'; exit 0; }
[ "$(getconf LONG_BIT)" = 64 ] || { echo 'skipped: lint-abi: the files of releases are of 64-bit machines'; exit 0; }

# ------------------------------------------------------------------ the layout

# types that no function names are kept, a pointer to each function holds its type
interface() {
  local name
  {
    echo '#include <ambulo/ambulo.h>'
    for name in $(cd "$include/.." && "$OLDPWD/.setup/symbols.sh" stable); do
      echo "__attribute__((used)) static __typeof__($name) *const f_$name = $name;"
    done
  } >"$work/all.c"
  $cc -std=gnu11 -gdwarf-4 -gstrict-dwarf -fno-eliminate-unused-debug-types -w -I"$include" -c "$work/all.c" -o "$work/all.o" || return 1
  readelf --debug-dump=info "$work/all.o" | awk '
    /^ *<[0-9a-f]+><[0-9a-f]+>: Abbrev Number: [1-9]/ {
      match($0, /<[0-9a-f]+><[0-9a-f]+>/); split(substr($0, RSTART + 1, RLENGTH - 2), at, "><")
      depth = at[1] + 0; id = at[2]; tag = $NF; gsub(/[()]/, "", tag)
      tags[id] = tag; within[depth] = id; parent[id] = depth ? within[depth - 1] : ""
      children[parent[id]] = children[parent[id]] " " id; ids[++count] = id
      next }
    / DW_AT_/ {
      match($0, /DW_AT_[a-z_]+/); key = substr($0, RSTART + 6, RLENGTH - 6)
      value = substr($0, RSTART + RLENGTH); sub(/^ *: */, "", value); sub(/ *$/, "", value)
      if (key == "name" || key == "const_value") sub(/^\(indirect string, offset: 0x[0-9a-f]+\): /, "", value)
      if (key == "type") gsub(/[<>x]|^<0x/, "", value)
      if (key == "type") sub(/^0/, "", value)
      at_of[id, key] = value }
    function type(id,   tag, target) {
      if (id == "") return "void"
      tag = tags[id]; target = at_of[id, "type"]
      if (tag == "DW_TAG_pointer_type") return type(target) (tags[target] == "DW_TAG_subroutine_type" ? "" : " *")
      if (tag == "DW_TAG_const_type") return tags[target] == "DW_TAG_pointer_type" ? type(target) "const" : "const " type(target)
      if (tag == "DW_TAG_volatile_type") return "volatile " type(target)
      if (tag == "DW_TAG_restrict_type") return type(target)
      if (tag == "DW_TAG_array_type") return type(target) extent(id)
      if (tag == "DW_TAG_subroutine_type") return type(target) " (*)(" parameters(id) ")"
      if (tag == "DW_TAG_structure_type") return "struct " at_of[id, "name"]
      if (tag == "DW_TAG_enumeration_type") return "enum " at_of[id, "name"]
      if (tag == "DW_TAG_union_type") return "union " at_of[id, "name"]
      return at_of[id, "name"] }
    function extent(id,   n, list, i, text, bound) {
      n = split(children[id], list, " ")
      for (i = 1; i <= n; i++) if (tags[list[i]] == "DW_TAG_subrange_type") {
        bound = at_of[list[i], "upper_bound"]; sub(/ .*/, "", bound); text = text "[" (bound == "" ? "" : bound + 1) "]" }
      return text }
    function parameters(id,   n, list, i, text) {
      n = split(children[id], list, " ")
      for (i = 1; i <= n; i++) {
        if (tags[list[i]] == "DW_TAG_formal_parameter") text = text (text == "" ? "" : ", ") type(at_of[list[i], "type"])
        if (tags[list[i]] == "DW_TAG_unspecified_parameters") text = text ", ..." }
      return text == "" ? "void" : text }
    function bytes(id,   tag, n, list, i, size, bound) {
      tag = tags[id]
      if (at_of[id, "byte_size"] != "") return at_of[id, "byte_size"] + 0
      if (tag != "DW_TAG_array_type") return at_of[id, "type"] == "" ? 0 : bytes(at_of[id, "type"])
      size = bytes(at_of[id, "type"]); n = split(children[id], list, " ")
      for (i = 1; i <= n; i++) if (tags[list[i]] == "DW_TAG_subrange_type") size *= at_of[list[i], "upper_bound"] + 1
      return size }
    END {
      for (i = 1; i <= count; i++) {
        id = ids[i]; name = at_of[id, "name"]; tag = tags[id]
        if (tag == "DW_TAG_variable" && name ~ /^f_ambulo_/) {
          target = at_of[id, "type"]
          while (tags[target] != "DW_TAG_subroutine_type") target = at_of[target, "type"]
          print "function " substr(name, 3) "(" parameters(target) ") " type(at_of[target, "type"]) }
        if (name !~ /^ambulo_/ ) continue
        if (tag == "DW_TAG_typedef" && tags[at_of[id, "type"]] !~ /structure|enumeration/)
          print "type " name " " type(at_of[id, "type"])
        n = split(children[id], list, " ")
        if (tag == "DW_TAG_structure_type" && at_of[id, "byte_size"] != "") {
          print "struct " name " " at_of[id, "byte_size"]
          for (j = 1; j <= n; j++) if (tags[list[j]] == "DW_TAG_member")
            print "member " name "." at_of[list[j], "name"] " " at_of[list[j], "data_member_location"] + 0 " " bytes(at_of[list[j], "type"]) " " type(at_of[list[j], "type"]) }
        if (tag == "DW_TAG_enumeration_type")
          for (j = 1; j <= n; j++) if (tags[list[j]] == "DW_TAG_enumerator")
            print "constant " at_of[list[j], "name"] " " at_of[list[j], "const_value"] " " name } }' |
    LC_ALL=C sort -u
}
interface >"$work/now" || { echo 'lint_abi.sh: the headers do not compile' >&2; exit 1; }
[ "$(grep -c ^function "$work/now")" = "$(cd "$include/.." && "$OLDPWD/.setup/symbols.sh" stable | wc -l)" ] &&
  grep -q '^member' "$work/now" && grep -q '^constant' "$work/now" ||
  { echo "lint_abi.sh: the debugging information of $cc could not be read" >&2; exit 1; }
[ "${1:-}" != print ] || { cat "$work/now"; exit 0; }

# --------------------------------------------------------------- what breaks

base=${ABI_BASE:-$(ls .setup/abi/*.txt | sort -V | tail -n 1)}
last=$(basename "$base" .txt)
next=${ABI_NEXT:-$(sed -nE '/^## \[/{s/^## \[Unreleased\] - ([0-9.]+).*/\1/;s/^## \[([0-9.]+)\].*/\1/;p;q}' CHANGELOG.md)}
series() { case $1 in 0.*) echo "$1" | cut -d. -f1,2 ;; *) echo "${1%%.*}" ;; esac; }
# a structure that begins with its size may grow at its end, its other lines stay
broken=$(awk '
  FNR == NR { now[$0] = 1; if ($1 == "struct") size[$2] = $3; line[$1 " " $2] = $0; next }
  $1 == "struct" { old_size[$2] = $3 }
  $1 == "member" && $2 ~ /\.size$/ && $3 == 0 { own = $2; sub(/\.size$/, "", own); sized[own] = 1 }
  $1 == "member" { old_member[$2] = 1 }
  { old[++n] = $0 }
  END {
    for (i = 1; i <= n; i++) {
      split(old[i], word, " "); key = word[1] " " word[2]
      if (old[i] in now) continue
      if (word[1] == "function") { sub(/\(.*/, "", key); key = "function " substr(key, 10); replaced = ""
        for (k in line) if (index(k, key "(") == 1) replaced = line[k] } else replaced = line[key]
      if (word[1] == "struct" && (word[2] in sized) && size[word[2]] >= word[3]) continue
      print old[i] (replaced == "" ? ": gone" : "\n    now: " replaced) }
    for (k in line) {
      split(line[k], word, " ")
      if (word[1] != "member" || (word[2] in old_member)) continue
      own = word[2]; sub(/\..*/, "", own)
      if ((own in sized) && word[3] + 0 < old_size[own] + 0) print line[k] ": lies in what was padding (the older structure has " old_size[own] " bytes)" } }' "$work/now" "$base")
gone=$(grep -c -v '^    now: ' <<<"$broken"); [ -n "$broken" ] || gone=0
added=$(LC_ALL=C comm -13 "$base" "$work/now" | grep -c .)
if [ "$gone" = 0 ]; then
  echo "$(grep -c . "$base") lines of the interface of $last hold; $added are new"
elif [ "$(series "$next")" != "$(series "$last")" ]; then
  echo "$gone of $(grep -c . "$base") lines of the interface of $last do not hold; $added are new; the next release is $next, with another soname"
else
  echo "$broken"
  echo "programs of $last break: $gone lines above; expected none, or another number than $next for the next release in CHANGELOG.md"
  exit 1
fi
