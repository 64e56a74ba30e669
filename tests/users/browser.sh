# shellcheck shell=bash disable=SC2154
# Sourced by long.sh: pages of tasks in a browser, headless, in the frames of one page.
# browser_checks NAME...: NAME.html of the present folder is the page of the problem NAME.
browser_checks() {
  local browser='' name running results line
  for name in chromium chromium-browser google-chrome; do
    [ -n "$browser" ] || browser=$(command -v "$name")
  done
  if [ -z "$browser" ]; then
    echo 'skipped without chromium: pages of tasks in a browser (make check-page installs it)'
    return
  fi
  echo '<!doctype html><meta charset="utf-8">' >all.html
  for name in "$@"; do
    awk -v kind="$name" -v first="$top/tests/show/watch.js" -v last="$here/checks.js" '
      function put(file, line) { while ((getline line < file) > 0) print line; close(file) }
      { print }
      /^<meta charset/ { print "<script>window.kind = \"" kind "\";"; put(first); print "</script>" }
      END { print "<script>"; put(last); print "</script>" }' "$name.html" >"$name-test.html"
    echo "<iframe width=500 height=400 src=\"$name-test.html#t=0.1\"></iframe>" >>all.html
  done
  "$browser" --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --ignore-gpu-blocklist --disable-extensions --no-first-run --disable-renderer-backgrounding \
    --disable-backgrounding-occluded-windows --user-data-dir="$PWD/profile" \
    --remote-debugging-port=0 --enable-logging=stderr --window-size=1100,900 \
    "file://$PWD/all.html" >browser.log 2>&1 &
  running=$!
  for _ in $(seq 600); do # at most a minute
    [ "$(grep -c 'check: end ' browser.log)" -lt $# ] && kill -0 "$running" 2>/dev/null || break
    sleep 0.1
  done
  kill "$running" 2>/dev/null
  wait "$running" 2>/dev/null
  results=$(sed -n 's/.*CONSOLE[^"]*"check: \(.*\)", source: .*/\1/p' browser.log)
  while IFS= read -r line; do
    case $line in
    'ok '*) passed=$((passed + 1)) ;;
    'FAILED '*) failed=$((failed + 1)); echo "$line" ;;
    esac
  done <<<"$results"
  for name in "$@"; do
    check "the checks of $name come to their end" grep -q "^end $name" <<<"$results"
  done
}
