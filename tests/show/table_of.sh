#!/usr/bin/env bash
# table_of.sh PAGE: the table of a study's page as it is packed there (src/study/study_page.c), as JSON.
# gzip reads the deflate format behind a head of ten bytes, and misses only its checksum.
{
  printf '\037\213\010\0\0\0\0\0\0\003'
  grep -o '"table":"[^"]*"' "$1" | cut -d '"' -f 4 | base64 -d
} | gzip -dc 2>/dev/null
true
