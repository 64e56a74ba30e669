#!/usr/bin/env bash
# The hook for commit messages refuses what it should, and nothing else. Prints "N passed, N failed".
set -u
hook=$(cd "$(dirname "$0")/../.." && pwd)/.githooks/commit-msg
message=$(mktemp) || exit 1
trap 'rm -f "$message"' EXIT
passed=0 failed=0
expect() { # STATUS TEXT
  printf '%b\n' "$2" >"$message"
  local status=0
  "$hook" "$message" 2>/dev/null || status=$?
  if [ "$status" = "$1" ]; then passed=$((passed + 1)); else
    failed=$((failed + 1))
    echo "FAILED: exit $status, expected $1: $2"
  fi
}
long=$(printf '%072d' 0)
expect 0 'Contact: the friction cone stands once'
expect 0 "$long"
expect 1 "${long}0"
expect 1 'WIP contact'
expect 1 'Merge /tmp/wt/audit'
expect 1 'Paths\n\nbuilt in /home/me/ambulo'
expect 0 'Docs: src/engine/base, /usr/local and 1/2'
expect 0 'Subject\n# a comment that git drops: /tmp/x'
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
