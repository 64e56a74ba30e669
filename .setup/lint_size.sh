#!/usr/bin/env bash
# Files of at most 400 lines, functions of at most 60 (from the brace to the brace). Reports the
# largest; fails for src/ and include/. Relies on the format that lint-format checks: a body
# begins with a line that ends in '{' and belongs to text in column one, and ends with '}' there.
set -u
awk -v most_file=400 -v most_function=60 '
  function fault(text) {
    print text
    if (FILENAME ~ /^(src|include)\//) faults++
  }
  function end_file() {
    if (file != "" && lines > most_file) {
      printf "%s: %d lines, expected at most %d\n", file, lines, most_file
      if (file ~ /^(src|include)\//) faults++
    }
    if (lines > longest_file && file ~ /^(src|include)\//) { longest_file = lines; its_file = file }
  }
  FNR == 1 { end_file(); file = FILENAME; name = ""; open = 0 }
  { lines = FNR }
  /^[A-Za-z_].*\(/ && !open { name = $0 }
  /^[A-Za-z_ ].*\{$/ && !open && name != "" && !/=[^=]*\{$/ && !/^(struct|enum|union|typedef)/ {
    open = FNR
    next
  }
  /;$/ && !open { name = "" }
  /^}/ && open {
    size = FNR - open + 1
    sub(/\(.*/, "", name)
    sub(/.*[ *]/, "", name)
    functions++
    if (size > most_function) {
      fault(sprintf("%s:%d: %s has %d lines, expected at most %d", file, open, name, size,
                    most_function))
    }
    if (size > longest && file ~ /^(src|include)\//) { longest = size; its_name = name }
    open = 0
    name = ""
  }
  END {
    end_file()
    printf "%d functions; longest in src: %s, %d lines; longest file: %s, %d lines\n", functions,
           its_name, longest, its_file, longest_file
    exit faults > 0
  }' $(find include src tests bench -name '*.[ch]' | sort)
