#!/usr/bin/env bash
# What a newcomer is led by stands where it is said to stand:
#
#   each folder of src/ has one file whose head has a "Reading order:", and every file it names is
#   in that folder, or below src/
#   every `src/...` file of docs/solver.md and docs/glossary.md exists, and every function named with
#   it is in it
#   no two headers of src/ declare types of one name
set -u
shopt -s nullglob
bad=0
say() {
  echo "$1"
  bad=1
}

for folder in src/engine/*/ src/files/*/ src/people/ src/import/ src/exchange/ src/retarget/ src/show/ src/study/ src/cli/; do
  mapfile -t heads < <(grep -lE '^( \* )?Reading order: ' "$folder"*.[ch] "$folder"*.py)
  if [ ${#heads[@]} -ne 1 ]; then
    say "$folder: ${#heads[@]} files with a reading order, expected one"
    continue
  fi
  while read -r name; do
    [ -f "$folder$name" ] || [ -f "src/$name" ] || say "${heads[0]}: no file $name in $folder"
  done < <(sed -nE '/^( \* )?Reading order: /,/^ \*\/|^ \*$|^$/p' "${heads[0]}" |
    grep -oE '[a-z0-9_/]+\.([ch]|py)\b')
done

for page in docs/solver.md docs/glossary.md; do
  while IFS=: read -r file name; do
    if [ ! -f "$file" ]; then
      say "$page: no file $file"
    elif [ -n "$name" ] && ! grep -qE "\b$name\b" "$file"; then
      say "$page: $file has no $name"
    fi
  done < <(grep -oE '`(src|tests|include)/[a-z0-9_/]+\.[a-z0-9]+(:[A-Za-z0-9_]+)?`' "$page" |
    tr -d '`' | sort -u)
done

for name in $(grep -rhoE '^(typedef )?(struct|union|enum) [a-z0-9_]+ \{' src --include='*.h' |
  sed -E 's/^(typedef )?[a-z]+ ([a-z0-9_]+) .*/\2/' | sort | uniq -d); do
  say "$name is declared in $(grep -rlE "(struct|union|enum) $name \{" src --include='*.h' | xargs)"
done
exit $bad
