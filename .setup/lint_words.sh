#!/usr/bin/env bash
# lint_words.sh [PAGE...]: the prose of the pages is short and plain.
#
#   - no sentence has more than 40 words;
#   - no page, shipped file or source has a phrase of the list below.
#
# Prose is what is left without code blocks, tables, headings, pictures and lines of YAML heads. Each
# paragraph and each item of a list stands by itself. Words in `code` count, a link counts as its text. A sentence ends at . ! or ? before a blank and a capital, a quote or code, or
# where its paragraph ends. --count prints pages, lines, sentences and long sentences, and judges
# nothing.
set -u
most=40
count=0
[ "${1:-}" != --count ] || { count=1; shift; }
[ $# -gt 0 ] || set -- README.md CONTRIBUTING.md ARCHITECTURE.md docs/*.md

# one a line, extended regular expressions
banned='comes? along
gone on from
goes on from
of which nothing
nothing good
want of memory
has all of it but
wide berth
is no error
is no way
gives? up (a|the) (trial )?point
given up
so many times as much
by so much
dearest
foretell
foretold
laid anew
stands? anew
makes of it
what (it|they) costs?\b
what stands around
(is|are) told\b
of its own accord
without a word
is borne
bearer'

prose='
function flush(    text, words, w, size, part) {
  if (paragraph == "") return
  text = paragraph
  paragraph = ""
  gsub(/!\[[^]]*\]\([^)]*\)/, "", text)
  while (match(text, /\[[^]]*\]\([^)]*\)/)) {
    w = substr(text, RSTART + 1, RLENGTH - 1)
    sub(/\]\([^)]*\)$/, "", w)
    text = substr(text, 1, RSTART - 1) w substr(text, RSTART + RLENGTH)
  }
  # dots in code end no sentence
  size = split(text, words, /`/)
  text = words[1]
  for (w = 2; w <= size; w++) {
    if (w % 2 == 0) gsub(/[.!?]/, ",", words[w])
    text = text (w % 2 == 0 ? "`" : "") words[w]
  }
  gsub(/[*]+/, "", text)
  # abbreviations and initials end no sentence
  gsub(/e\.g\./, "eg", text)
  gsub(/i\.e\./, "ie", text)
  gsub(/et al\./, "et al", text)
  gsub(/Figs?\./, "Fig", text)
  while (match(text, /[ (][A-Z]\. /)) text = substr(text, 1, RSTART + 1) substr(text, RSTART + 3)
  while (text != "") {
    if (match(text, /[.!?][)"]* +[A-Z"(0-9`]/)) {
      part = substr(text, 1, RSTART + RLENGTH - 2)
      text = substr(text, RSTART + RLENGTH - 1)
    } else {
      part = text
      text = ""
    }
    size = 0
    for (w = split(part, words, /[ \t]+/); w > 0; w--) if (words[w] ~ /[A-Za-z0-9]/) size++
    if (size > 0) printf "%s:%d\t%d\t%s\n", page, first, size, part
  }
}
FNR == 1 { flush(); page = FILENAME; fenced = indented = blank = list = 0 }
/^ *```/ { flush(); fenced = !fenced; blank = 0; next }
fenced { next }
/^ *$/ { flush(); blank = 1; next }
/^    / && !list && (blank || indented) { indented = 1; next }
{ indented = 0 }
/^\|/ || /^#/ { flush(); blank = list = 0; next }
/^ *([-*]|[0-9]+\.) / { flush(); sub(/^ *([-*]|[0-9]+\.) +/, ""); list = 1 }
/^[^ ]/ && blank { list = 0 }
{
  if (paragraph == "") first = FNR
  paragraph = paragraph (paragraph == "" ? "" : " ") $0
  blank = 0
}
END { flush() }'

bad=0
pages=()
for page in "$@"; do [ -f "$page" ] && pages+=("$page"); done
sentences=$(awk "$prose" "${pages[@]}")
if [ $count = 1 ]; then
  printf '%-28s %6s %6s %6s\n' page lines sentences "over $most"
  for page in "${pages[@]}"; do
    awk -F '\t' -v page="$page" -v most=$most -v lines="$(wc -l <"$page")" '
      index($1, page ":") == 1 { n++; if ($2 > most) long++ }
      END { printf "%-28s %6d %6d %6d\n", page, lines, n, long }' <<<"$sentences"
  done
  awk -F '\t' -v most=$most '{ n++; if ($2 > most) long++ } END { printf "all: %d sentences, %d over %d words\n", n, long, most }' <<<"$sentences"
  exit 0
fi
while IFS=$'\t' read -r place words text; do
  [ -n "$place" ] || continue
  echo "$place: a sentence of $words words (expected at most $most): ${text:0:90}..."
  bad=1
done < <(awk -F '\t' -v most=$most '$2 > most' <<<"$sentences")
while IFS= read -r hit; do
  echo "$hit: a phrase that is not English; see the list in .setup/lint_words.sh"
  bad=1
done < <(for page in "${pages[@]}" models/*.yaml; do
  sed 's/`[^`]*`/Code/g' "$page" | grep -nEi -f <(echo "$banned") | cut -c1-140 | sed "s#^#$page:#"
done
grep -rnEi -f <(echo "$banned") src include --include='*.[ch]' --include='*.py' | cut -c1-140)
exit $bad
