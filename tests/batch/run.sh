#!/usr/bin/env bash
# A few random kills on every check; `make check-kill` deals two hundred.
here=$(cd "$(dirname "$0")" && pwd)
if KILLS=12 "$here/kill_test.sh"; then echo "1 passed, 0 failed"; else echo "0 passed, 1 failed"; exit 1; fi
