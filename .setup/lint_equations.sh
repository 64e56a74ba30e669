#!/usr/bin/env bash
# docs/equations.md against the source, both ways.
#
#   page to code   every `file:function` that a row names is defined there, and the comment above it
#                  has the row's tags: "(P.10)", with an ASCII prime: "(16')"
#   code to page   every tag of such a comment has a row, and the row names that file; every "Eq. 17'"
#                  that a comment cites has a row
set -u
document=docs/equations.md
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0
say() {
  echo "$1"
  bad=1
}

# "tag<TAB>file:function" of each row, "tag<TAB>-" where it names none
sed "s/′/'/g" "$document" | awk -F' [|] ' '
  /^\| \(/ {
    places = 0
    rest = $0
    while (match(rest, /`(src|include)\/[a-z0-9_\/]+\.[ch]:[a-z0-9_]+`/)) {
      place[places++] = substr(rest, RSTART + 1, RLENGTH - 2)
      rest = substr(rest, RSTART + RLENGTH)
    }
    tags = $1
    while (match(tags, /\([^)]*\)/)) {
      tag = substr(tags, RSTART + 1, RLENGTH - 2)
      tags = substr(tags, RSTART + RLENGTH)
      for (i = 0; i < places; i++) print tag "\t" place[i]
      if (!places) print tag "\t-"
    }
  }' >"$work/rows"
cut -f1 "$work/rows" | sort -u >"$work/tags"

# the comment that ends right above the definition of $2 in $1, or nothing
comment_above() {
  awk -v name="$2" '
    function starts(line) { return line ~ "^[A-Za-z_][^;=]*[^A-Za-z0-9_]" name "\\(" }
    /^\/\*/ { comment = ""; inside = 1 }
    inside { comment = comment " " $0; if (/\*\//) { inside = 0; fresh = NR } ; next }
    starts($0) { # a prototype ends with a semicolon before any brace
      head = $0; kept = (NR - fresh <= 2) ? comment : ""
      while (head !~ /[;{]/ && (getline line) > 0) head = head " " line
      if (head ~ /^[^;]*\{/) { print kept; exit }
    }' "$1"
}

# page to code
while IFS=$'\t' read -r tag place; do
  file=${place%%:*} name=${place##*:}
  [ "$place" != - ] || continue
  if [ ! -f "$file" ]; then
    say "$document: no file $file"
  elif ! grep -qE "^[A-Za-z_][^;=]*\b$name\(" "$file"; then
    say "$document: $file defines no $name()"
  elif ! comment_above "$file" "$name" | grep -qF "($tag)"; then
    say "$file: the comment above $name() lacks ($tag), as $document has it"
  fi
done <"$work/rows"
while read -r tag; do
  grep -qP "^\Q$tag\E\t(?!-)" "$work/rows" || grep -F "($tag)" "$document" | grep -q 'implied by' ||
    say "$document: no function for ($tag)"
done <"$work/tags"

# code to page: at the head of a comment, "/* (P.1) (P.2): ..."
grep -rnoE "^/\*( \([A-Z0-9][A-Za-z0-9.' ]*\))+" src include --include='*.[ch]' |
  while IFS=: read -r file _ head; do
    grep -oE "\([^)]*\)" <<<"$head" | tr -d '()' | sed "s|\$|\t$file|"
  done | sort -u >"$work/used"
# anywhere: (P.10), (13.a), (W.C)
grep -rnoE "\((([AIPSW]\.[0-9A-Z]+)|(1[34]\.))[a-z]?\)" src include --include='*.[ch]' |
  sed -E 's/^([^:]*):[0-9]*:\((.*)\)$/\2\t\1/' | sort -u >>"$work/used"
while IFS=$'\t' read -r tag file; do
  if ! grep -qxF "$tag" "$work/tags"; then
    say "$file has the tag ($tag); $document has no row for it"
  elif ! grep -F "$tag	$file:" "$work/rows" | grep -qP "^\Q$tag\E\t"; then
    say "$file has the tag ($tag), whose row in $document does not name that file"
  fi
done < <(sort -u "$work/used")

# "Eq. (10)", "Eqs. 18-19", "Eq. 17'": citations
while IFS=: read -r file tag; do
  grep -qxF "$tag" "$work/tags" || say "$file cites equation ($tag); $document has no row for it"
done < <(grep -rnoE "Eqs?\. \(?[0-9]+'?" src include --include='*.[ch]' |
  sed -E "s/^([^:]*):[0-9]+:Eqs?\. \(?/\1:/" | sort -u)

exit $bad
