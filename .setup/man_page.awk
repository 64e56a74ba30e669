# man_page.awk: a page of docs/ as a manual page, man(7) source on standard output.
#
#   awk -f .setup/man_page.awk -v name=ambulo-problem -v section=5 -v date=2026-11-23 \
#     -v about='the format of problem files' -v version=0.2.0 docs/problem-format.md
#
# What the pages use: headings, paragraphs, lists, tables, code (fenced or indented by four columns),
# `code`, **bold**, *italic*, [links](...). A row of a table becomes an item: its first cell, then
# the others. Pictures are left out. Any awk will do; bytes beyond ASCII are passed on.
function escape(text) {
  gsub(/\\/, "\\e", text)
  return text
}
function line(text) { # a line of source that is no request
  if (text ~ /^[.']/) text = "\\&" text
  print text
}
function prose(text,    count, word, i, out) {
  count = split(text, word, /[ \t]+/)
  out = ""
  for (i = 1; i <= count; i++) {
    if (word[i] == "") continue
    if (out != "" && length(out) + 1 + length(word[i]) > 76) { line(out); out = "" }
    out = out == "" ? word[i] : out " " word[i]
  }
  if (out != "") line(out)
}
function plain_links(text,    before, label) {
  while (match(text, /!?\[[^]]*\]\([^)]*\)/)) {
    before = substr(text, 1, RSTART - 1)
    label = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    if (label ~ /^!/) label = ""
    sub(/^\[/, "", label)
    sub(/\]\([^)]*\)$/, "", label)
    text = before label text
  }
  return text
}
# marks outside code are fonts, inside they are letters
function fonts(text,    part, count, i, out) {
  count = split(text, part, /`/)
  out = ""
  for (i = 1; i <= count; i++) {
    if (i % 2 == 0) {
      gsub(/-/, "\\-", part[i])
      out = out "\\fB" part[i] "\\fR"
      continue
    }
    while (match(part[i], /\*\*[^*]+\*\*/))
      part[i] = substr(part[i], 1, RSTART - 1) "\\fB" substr(part[i], RSTART + 2, RLENGTH - 4) \
        "\\fR" substr(part[i], RSTART + RLENGTH)
    while (match(part[i], /\*[^* ][^*]*\*/))
      part[i] = substr(part[i], 1, RSTART - 1) "\\fI" substr(part[i], RSTART + 1, RLENGTH - 2) \
        "\\fR" substr(part[i], RSTART + RLENGTH)
    out = out part[i]
  }
  return out
}
function inline(text) { return fonts(escape(plain_links(text))) }
function paragraph_mark() { # none at the start of a section
  if (!opened) print ".PP"
  opened = 0
}
function flush() { # the paragraph so far
  if (paragraph != "") { prose(inline(paragraph)); paragraph = "" }
}
function code(text) {
  text = escape(text)
  gsub(/-/, "\\-", text)
  line(text)
}
function row(text,    cell, count, i, rest) {
  gsub(/\\\|/, "\001", text)
  sub(/^\| */, "", text)
  sub(/ *\| *$/, "", text)
  count = split(text, cell, / *\| */)
  for (i = 1; i <= count; i++) gsub(/\001/, "|", cell[i])
  if (cell[1] ~ /^[-: ]*$/ && cell[2] ~ /^[-: ]*$/) return
  rest = ""
  for (i = 2; i <= count; i++) if (cell[i] != "") rest = rest (rest == "" ? "" : "; ") cell[i]
  if (!in_table) {
    in_table = 1
    if (cell[1] != "" || rest != "") { paragraph_mark(); prose("\\fI" inline(cell[1] (rest == "" ? "" : "; " rest)) "\\fR:") }
    return
  }
  print ".TP"
  line(cell[1] == "" ? "\\(em" : inline(cell[1]))
  prose(rest == "" ? "\\(em" : inline(rest))
}
BEGIN {
  print ".\\\" -*- coding: utf-8 -*-"
  printf ".TH %s %s %s \"ambulo %s\" Ambulo\n.SH NAME\n%s \\- %s\n.SH DESCRIPTION\n", \
    toupper(name), section, date, version, name, about
  opened = 1
}
/^ *```/ {
  flush()
  if (fenced) print ".fi"
  else { paragraph_mark(); print ".nf" }
  fenced = !fenced
  next
}
fenced { code($0); next }
/^    [^ ]/ && blank && !in_list { flush(); if (!indented) { paragraph_mark(); print ".nf" } indented = 1 }
indented && /^    / { code(substr($0, 5)); next }
indented { print ".fi"; indented = 0 }
/^ *$/ { flush(); blank = 1; in_table = 0; next }
/^# / { blank = 0; next }
/^## / { flush(); print ".SH " toupper(inline(substr($0, 4))); blank = in_list = fresh = 0; opened = 1; next }
/^###+ / { flush(); sub(/^#+ /, ""); print ".SS " inline($0); blank = in_list = 0; opened = 1; next }
/^\|/ { flush(); row($0); blank = in_list = 0; next }
/^ *([-*]|[0-9]+\.) / {
  flush()
  mark = $1 ~ /^[0-9]/ ? $1 : "\\(bu"
  print ".IP " mark " 4"
  sub(/^ *([-*]|[0-9]+\.) +/, "")
  paragraph = $0
  in_list = 1
  blank = 0
  next
}
{
  if (blank && paragraph == "") {
    if (in_list && !/^ /) in_list = 0
    if (!in_list) paragraph_mark()
  }
  opened = blank = 0
  paragraph = paragraph == "" ? $0 : paragraph " " $0
}
END { flush(); if (indented || fenced) print ".fi" }
