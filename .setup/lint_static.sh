#!/usr/bin/env bash
# lint_static.sh JOBS SOURCES... -- FLAGS...: clang-tidy with .clang-tidy, findings only.
set -u
jobs=$1
shift
sources=()
while [ "$1" != -- ]; do
  sources+=("$1")
  shift
done
shift
tidy_one() {
  local source=$1 status=0 text
  shift
  text=$(clang-tidy --quiet "$source" -- "$@" 2>/dev/null) || status=$?
  [ -z "$text" ] || printf '%s\n' "$text"
  return "$status"
}
export -f tidy_one
printf '%s\0' "${sources[@]}" | xargs -0 -P "$jobs" -I{} bash -c 'tidy_one "$@"' tidy {} "$@"
