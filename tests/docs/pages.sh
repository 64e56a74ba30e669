# Facts that the pages state, compared with the sources and the program; sourced by run.sh, which
# gives `count` and `in_world`. Each function prints what is wrong, and fails.
# shellcheck shell=bash disable=SC2317

# each command of the overview has a row in docs/cli.md
commands_documented() {
  local command lost=0
  [ -s "$work/commands" ] || return 1
  while read -r command; do
    grep -q "^| \`ambulo $command " docs/cli.md || { echo "no row for $command"; lost=1; }
  done <"$work/commands"
  return $lost
}

# every key of summary.json (but the names of terms, feet and coordinates) stands in docs/results.md
keys_documented() {
  local key lost=0
  [ -s "$1" ] || return 1
  for key in $(sed '/"terms": {/,/}/d; /"\(left\|right\)": {/d; /"coordinates": {/,/^    }/d' "$1" | grep -oE '"[a-z_]+":' | tr -d '":' | sort -u); do
    grep -qE "\`[^\`]*\b$key\b[^\`]*\`" docs/results.md ||
      { echo "docs/results.md has no word about '$key'"; lost=1; }
  done
  return $lost
}

# and so does every kind of column of motion.csv
columns_documented() {
  local kind lost=0
  [ -s "$1" ] || return 1
  for kind in $(grep -v '^#' "$1" | head -n 1 | tr ',' '\n' | sed 's/\..*//' | sort -u); do
    grep -qE "^\| \`$kind[.\`]" docs/results.md ||
      { echo "docs/results.md has no row for the columns '$kind'"; lost=1; }
  done
  return $lost
}

# no link of a page leads nowhere, neither to a file nor to a heading
links_lead_somewhere() {
  local page target file anchor lost=0
  for page in README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md docs/*.md; do
    while read -r target; do
      file=${target%%#*} anchor=
      case $target in *'#'*) anchor=${target#*#} ;; esac
      if [ -n "$file" ]; then file=$(dirname "$page")/$file; else file=$page; fi
      [ -e "$file" ] || { echo "$page: no $target"; lost=1; continue; }
      [ -z "$anchor" ] || sed -n 's/^#* //p' "$file" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-' |
        grep -qx -e "$anchor" || { echo "$page: no heading $target"; lost=1; }
    done < <(grep -oE '\]\([^) ]+\)' "$page" | sed 's/^](//; s/)$//' | grep -v '^https\?:')
  done
  return $lost
}

pages_are_linked() {
  local page lost=0
  for page in docs/*.md; do
    grep -q "]($page)" README.md || { echo "README.md does not lead to $page"; lost=1; }
  done
  return $lost
}

# files that a page names in code are there: models/..., src/..., tests/..., bench/..., docs/...
files_are_there() {
  local page name lost=0
  for page in README.md docs/*.md; do
    while read -r name; do
      compgen -G "$name" >/dev/null || { echo "$page: no $name"; lost=1; }
    done < <(grep -oE '\b(models|src|tests|bench|docs|include)/[A-Za-z0-9_./-]*\.(yaml|csv|c|h|sh|md|svg)\b' "$page" |
      grep -v '^docs/images' | sort -u)
  done
  return $lost
}

# options that a page gives to a command are among those of its --help, or of a script in docs/examples
options_exist() {
  local page option lost=0 command
  : >"$work/options"
  while read -r command; do "$out/ambulo" "$command" --help; done <"$work/commands" >"$work/options"
  "$out/ambulo" --help >>"$work/options"
  grep -ohE -e '"(--)?[a-z-]+"' docs/examples/*.py | sed -E 's/"(--)?/--/' >>"$work/options"
  for page in README.md docs/*.md; do
    while read -r option; do
      grep -q -e "$option\b" "$work/options" || { echo "$page: no option $option"; lost=1; }
    done < <(grep -oE '(^|[ `(])--[a-z][a-z-]+' "$page" | grep -oE -e '--[a-z-]+' | sort -u |
      grep -vxE -e '--(cflags|libs|static|variable|export|sshloginfile|prefix|array|cpus-per-task|job-name|output)')
  done
  return $lost
}

# functions, types, constants and settings that the pages name are in the headers, in Python, or in the
# scripts of the tests
names_exist() {
  local page name lost=0
  for page in README.md docs/*.md; do
    while read -r name; do
      grep -rqE "\b$name\b" --include='*.h' --include='*.py' --include='*.sh' include src tests || { echo "$page: no $name"; lost=1; }
    done < <(grep -oE '\b(ambulo_[a-z_]*[a-z]|AMBULO_[A-Z_]*[A-Z])\b' "$page" | sort -u)
  done
  return $lost
}

judge_pages() {
  local folder=$work/facts
  mkdir "$folder"
  count 'README leads to every page' pages_are_linked
  count 'links of the pages' links_lead_somewhere
  count 'files that the pages name' files_are_there
  count 'options that the pages name' options_exist
  count 'functions that the pages name' names_exist
  count 'docs/cli.md: commands' commands_documented
  count 'a walk without ground reaction' \
    "$out/ambulo" solve models/walk_without_reaction.yaml -o "$folder/plain" --quiet
  count 'its keys are documented' keys_documented "$folder/plain/summary.json"
  count 'its columns are documented' columns_documented "$folder/plain/motion.csv"
  count 'a walk with ground reaction' \
    "$out/ambulo" solve models/walk_normal.yaml -o "$folder/grounded" --quiet
  count 'its keys are documented, too' keys_documented "$folder/grounded/summary.json"
  count 'its columns are documented, too' columns_documented "$folder/grounded/motion.csv"
}
