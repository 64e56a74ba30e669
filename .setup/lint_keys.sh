#!/usr/bin/env bash
# Every key that a reader of model or problem files asks for, or that the table of members has, stands
# in code marks in the page that documents the format; every key in the first column of such a page is
# asked for.
set -u
bad=0

# keys_of FILES...: names handed to the functions that look keys up, and those of tables of members
keys_of() {
  cat "$@" | tr '\n' ' ' |
    grep -oE '(yaml_(get|require|expect)|reader_section)\([a-z_>.&-]+, "[a-z_]+"|\{[A-Z]+\("[a-z_.]+"' |
    sed -E 's/.*["]([a-z_.]+)"/\1/; s/.*\.//' | sort -u
}

# compare PAGE FILES...
compare() {
  local page=$1 key
  shift
  local asked
  asked=$(keys_of "$@")
  for key in $asked; do
    grep -qE "\`$key\`" "$page" || { echo "$page has no word about the key '$key'"; bad=1; }
  done
  # first columns of tables whose head is "key"
  while IFS= read -r key; do
    grep -qE "[.\"]$key\"" "$@" || { echo "$page: no reader asks for '$key'"; bad=1; }
  done < <(awk '/^\| key \|/ { on = 1; next } !/^\|/ { on = 0 } on' "$page" |
    sed -E 's/^\| ([^|]*) \|.*/\1/' | grep -oE '`[a-z_]+`' | tr -d '`' | sort -u)
}

compare docs/muscles-format.md src/files/definitions/muscle_file.c src/files/formats/yaml_load.c
compare docs/model-format.md src/files/definitions/model_*.c src/files/formats/yaml_load.c
compare docs/problem-format.md src/files/definitions/problem_*.c src/engine/problem/members.c src/files/formats/yaml_load.c
# shellcheck disable=SC2046 # of fit_*.c, those that read and write other files
compare docs/guide-fit.md $(ls src/study/fit_*.c | grep -vE 'report|run|search|solves|values')
exit $bad
