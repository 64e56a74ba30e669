#!/usr/bin/env bash
# lint_architecture.sh: what ARCHITECTURE.md claims is so.
#
#   every file and folder that it names exists
#   its table of rooms names all of them, in the order of .setup/lint_order.sh
#   "The way of one control point" has at most 60 files
#   each paragraph of "Where to add" gives an example, (example: `NAME`), and names exactly the files
#   of src/ and include/ in which that name stands
set -u
page=ARCHITECTURE.md
most=60
bad=0
say() {
  echo "$page: $1"
  bad=1
}

while read -r name; do
  [ -e "$name" ] || say "no $name"
done < <(grep -oE '`(src|tests|include|docs)/[A-Za-z0-9_./-]*`' "$page" | tr -d '`' | sort -u)

order=$(sed -n '/^order=(/,/)/p' .setup/lint_order.sh | tr -d '\n' | sed 's/.*(//; s/).*//' | xargs)
listed=$(sed -nE '/^\| room /,/^$/s/^\| `src\/([a-z/]*)`.*/\1/p' "$page" | sed 's/.*\///' | xargs)
[ "$order" = "$listed" ] || say "rooms are '$listed'; expected '$order'"
for folder in src/engine/*/ src/files/*/ src/*/; do
  case $folder in src/engine/ | src/files/ | src/python/) continue ;; esac
  grep -q "^| \`${folder%/}\`" "$page" || say "the table of rooms lacks ${folder%/}"
done

count=$(sed -n '/^## The way of one control point/,/^## /p' "$page" | grep -oE '`src/[a-z0-9_/]+\.[ch]`' | sort -u | wc -l)
[ "$count" -gt 0 ] || say 'no way of one control point'
[ "$count" -le $most ] || say "the way has $count files; expected at most $most"

# one paragraph a line
examples=0
while IFS= read -r paragraph; do
  name=$(sed -nE 's/.*\(example: `([A-Za-z0-9_]+)`\).*/\1/p' <<<"$paragraph")
  [ -n "$name" ] || continue
  examples=$((examples + 1))
  difference=$(diff <(grep -oE '`(src|include)/[a-z0-9_/]+\.[ch]`' <<<"$paragraph" | tr -d '`' | sort -u) \
    <(grep -rlw "$name" src include --include='*.[ch]' | sort)) || say "$name stands in other files than those named (<): $difference"
done < <(sed -n '/^## Where to add/,$p' "$page" | awk -v RS= '{ gsub(/\n/, " "); print }')
[ "$examples" = 4 ] || say "$examples examples under \"Where to add\"; expected 4"
exit $bad
