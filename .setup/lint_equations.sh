#!/usr/bin/env bash
# docs/equations.md against the source, both ways: every `file:function` it names exists, and
# every numbered equation that the source cites has a row in it.
set -u
document=docs/equations.md
bad=0

while IFS=: read -r file name; do
  if [ ! -f "$file" ]; then
    echo "$document: no file $file"
    bad=1
  elif ! grep -qE "^[A-Za-z_][^;=]*\b$name\(" "$file"; then
    echo "$document: $file defines no $name()"
    bad=1
  fi
done < <(grep -oE '`(src|include)/[a-z0-9_/]+\.[ch]:[a-z0-9_]+`' "$document" | tr -d '`' | sort -u)

# "Eq. (10)", "Eqs. 18-19", "Eq. 17'" in comments; a row starts with its tags
rows=$(grep -E '^\| \(' "$document" | sed "s/^| //; s/ |.*//; s/′/'/g")
while IFS=: read -r file tag; do
  if ! grep -qF "($tag)" <<<"$rows"; then
    echo "$file cites equation ($tag); $document has no row for it"
    bad=1
  fi
done < <(grep -oE "Eqs?\. \(?[0-9]+'?" -r src include --include='*.[ch]' | sed -E "s/Eqs?\. \(?//" | sort -u)

exit $bad
