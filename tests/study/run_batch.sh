#!/usr/bin/env bash
# A few random kills and a full disk on every check; `make check-kill` deals five hundred.
here=$(cd "$(dirname "$0")" && pwd)
passed=0 failed=0
count() { if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi; }
KILLS=12 count "$here/kill_test.sh"
SWEEP=$here/front.yaml KILLS=12 count "$here/kill_test.sh"
count "$here/disk_test.sh"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
