#!/usr/bin/env bash
# lint_interface.sh [FOLDER]: what the public headers promise of every declaration (ambulo/status.h).
#   - no function has more than 7 parameters: more are a structure
#   - the first constant of an enumeration is 0 and says that nothing was chosen, or that it is off
#   - a structure that a caller fills (a function takes it as `const ambulo_x *`) begins with its
#     size, has ambulo_x_default(), and the sizes of the items and parts in it
#   - an item or a part of those has ambulo_x_default()
# What the library fills itself, and what has no size, is listed below with the reason.
set -u
folder=${1:-include/ambulo}
cat "$folder"/*.h "$folder"/tools/*.h | awk '
  # 0 means something here: success; nothing was judged, no solver ran
  BEGIN { split("ambulo_status ambulo_verdict ambulo_ending", names, " "); for (i in names) listed[names[i]] = 1
    # filled by the library and handed back to it
    split("ambulo_fault ambulo_sensitivity_list ambulo_progress", names, " "); for (i in names) ours[names[i]] = 1
    # one function and its user, for ever (status.h)
    ours["ambulo_allocator"] = 1 }
  { text = text " " $0 "\n" }
  END {
    gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", text)          # comments
    gsub(/\\\n/, " ", text)                                # continued lines
    while (match(text, /\n *#[^\n]*/)) text = substr(text, 1, RSTART - 1) " " substr(text, RSTART + RLENGTH)
    gsub(/[ \t\n]+/, " ", text)
    rest = text
    while (match(rest, /AMBULO_([A-Z]+_)?DEFAULT\([a-z_]+\)/)) {
      one = substr(rest, RSTART, RLENGTH - 1); rest = substr(rest, RSTART + RLENGTH)
      sub(/.*\(/, "", one); defaults[one] = 1 }
    rest = text
    while (match(rest, /ambulo_[a-z_]+_default\(/)) {
      defaults[substr(rest, RSTART, RLENGTH - 9)] = 1; rest = substr(rest, RSTART + RLENGTH) }
    rest = text
    while (match(rest, /typedef enum [a-z_]+ \{[^}]*\}/)) {
      one = substr(rest, RSTART + 13, RLENGTH - 13); rest = substr(rest, RSTART + RLENGTH)
      name = one; sub(/ .*/, "", name); sub(/^[^{]*\{ */, "", one); sub(/ *[,}].*/, "", one)
      enums++
      if (name in listed) continue
      if (one !~ /^AMBULO_[A-Z_]*(NOT_SET|NONE|OFF|DEFAULT|UNKNOWN|FREE|AUTO|ALL|AS_IS|OF_FILE|NOT_RUN) = 0$/)
        fault(name ": its first constant is \"" one "\"; expected ..._NOT_SET = 0, or another word for nothing chosen") }
    rest = text
    while (match(rest, /typedef struct [a-z_]+ \{[^}]*\}/)) {
      one = substr(rest, RSTART + 15, RLENGTH - 16); rest = substr(rest, RSTART + RLENGTH)
      name = one; sub(/ .*/, "", name); sub(/^[^{]*\{ */, "", one); body[name] = one }
    rest = text
    while (match(rest, /AMBULO_API [^;{]*\)/)) {
      one = substr(rest, RSTART, RLENGTH); rest = substr(rest, RSTART + RLENGTH)
      sub(/\).*#.*/, ")", one)
      match(one, /ambulo_[a-z_0-9]+\(/); name = substr(one, RSTART, RLENGTH - 1)
      if (name == "" || name ~ /##/) continue
      functions++
      list = substr(one, RSTART + RLENGTH); count = 1
      while (match(list, /\([^()]*\)/)) list = substr(list, 1, RSTART - 1) substr(list, RSTART + RLENGTH)
      count += gsub(/,/, ",", list)
      if (count > 7) fault(name "() has " count " parameters; expected at most 7, and a structure")
      while (match(list, /const ambulo_[a-z_]+ \*[a-z]/)) {
        name = substr(list, RSTART + 6, RLENGTH - 9); list = substr(list, RSTART + RLENGTH)
        if (name in body && !(name in ours)) taken[name] = 1 } }
    for (name in taken) check(name)
    for (name in taken) number++
    if (!bad) print functions " functions of at most 7 parameters, " enums " enumerations, " number " structures with a size"
    exit bad
  }
  function fault(what) { print what; bad = 1 }
  function check(name,   n, parts, i, member, type) {
    if (body[name] !~ /^size_t size[;,]/) fault(name ": its first member is not size_t size")
    if (!(name in defaults)) fault(name ": there is no " name "_default()")
    n = split(body[name], parts, ";")
    for (i = 1; i <= n; i++) {
      member = parts[i]; sub(/^ +/, "", member)
      if (member !~ /^(const )?ambulo_[a-z_]+ \*?[a-z]/) continue
      type = member; sub(/^const /, "", type); sub(/ .*/, "", type)
      if (!(type in body) || type in ours || type in taken) continue
      if (!is_given(name, type, member)) continue
      if (!(type in defaults)) fault(type ", in " name ": there is no " type "_default()")
      item = type; sub(/^ambulo_/, "", item)
      if (body[name] !~ "[ ,]" item "_size[,;]") fault(name ": it holds " type ", and has no " item "_size")
      inner(name, type) } }
  # arrays that a part by value holds: their sizes stand in the whole
  function inner(name, type,   n, parts, i, member, item) {
    n = split(body[type], parts, ";")
    for (i = 1; i <= n; i++) {
      member = parts[i]; sub(/^ +/, "", member)
      if (member !~ /^const ambulo_[a-z_]+ \*/) continue
      item = member; sub(/^const ambulo_/, "", item); sub(/ .*/, "", item)
      if (!(("ambulo_" item) in body)) continue
      if (!(("ambulo_" item) in defaults)) fault("ambulo_" item ", in " type ": there is no default")
      if (body[name] !~ "[ ,]" item "_size[,;]") fault(name ": " type " in it holds ambulo_" item ", and there is no " item "_size") } }
  # pointers that are no const are places for results
  function is_given(name, type, member) { return member ~ /^const / || member !~ /\*/ }
'
