#!/usr/bin/env bash
# The page in a browser, headless: eight pages in the frames of one, each used as a person would
# (checks.js) and watched for errors (watch.js): a walk with a name that is code, beside another
# result; a walk with muscles; a failed solve; a study; a study of two axes; a front; a robot with
# meshes; and a browser without WebGL. Without chromium it is skipped, but for what needs none: the
# size of pages, and that the built page is that of its sources. `make check-page` installs a browser. Prints "N passed, N
# failed".
set -u
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
AMBULO=${AMBULO:-$top/build/ambulo}
AMBULO=$(cd "$(dirname "$AMBULO")" && pwd)/$(basename "$AMBULO")
export OPENBLAS_NUM_THREADS=1 LC_ALL=C.UTF-8
work=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-page-XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
passed=0 failed=0
check() { # what, command...
  local what=$1
  shift
  if "$@"; then passed=$((passed + 1)); else
    failed=$((failed + 1))
    echo "FAILED: $what"
  fi
}
browser=
for name in chromium chromium-browser google-chrome; do
  [ -n "$browser" ] || browser=$(command -v "$name")
done

# --------------------------------------------------- without a browser

cd "$top/src/show/viewer" || exit 1
# the order is that of build.mjs
digest=$(printf '%s\n' *.js *.mjs *.css *.html *.json | LC_ALL=C sort | xargs cat | sha256sum)
check "src/show/viewer.html is older than its sources: make viewer" \
  grep -q "name=\"sources\" content=\"${digest%% *}\"" ../viewer.html
cd "$work" || exit 1

models=$top/models
{
  "$AMBULO" solve "$models/walk.yaml" -o walk -q
  "$AMBULO" solve "$models/walk.yaml" --set gait.speed=1.6 -o "brisk<b>" -q
  "$AMBULO" solve "$models/walk.yaml" --muscles leg_muscles -o muscles -q
  "$AMBULO" solve "$models/two_link_reach.yaml" --set time.duration=0.02 -o failed -q
  printf 'ambulo: 1\nkind: sweep\nname: small_study\nbase: %s/two_link_reach.yaml\naxes:\n  - {key: time.duration, name: time, values: [1, 1.1, 1.2, 1.3]}\noutputs: [objective]\n' \
    "$models" | sed 's/1, 1.1, 1.2/0.9, 1, 1.1/' >study.yaml
  "$AMBULO" batch study.yaml -o study -q
  # an axis that hardly matters before one that does, outputs that hardly vary before one that does
  printf 'ambulo: 1\nkind: sweep\nname: two_axes\nbase: %s/two_link_reach.yaml\naxes:\n  - {key: time.intervals, name: nodes, values: [20, 22, 24]}\n  - {key: "model.links[lower].body.mass", name: mass, values: [1, 1.5, 2]}\noutputs: [duration, audit.violation.worst, objective]\n' \
    "$models" >axes.yaml
  "$AMBULO" batch axes.yaml -o axes -q
  "$AMBULO" batch "$top/tests/study/front.yaml" -o front -q
  # a robot that is a box and an arm, a model of MuJoCo's
  cat >robot.xml <<'END'
<mujoco model="robot"><worldbody><body name="base" pos="0 0 1"><geom type="box" size=".1 .2 .3"/>
<joint name="base" type="hinge" axis="0 0 1"/><body name="arm" pos=".2 0 0"><joint name="arm"
type="hinge" axis="0 1 0"/><geom type="capsule" size=".05 .3" pos="0 0 -.3"/></body></body>
</worldbody></mujoco>
END
  "$AMBULO" import robot.xml -o robot.yaml
  printf 'ambulo: 1\nkind: problem\nname: robot\nmodel: robot.yaml\nangles: degrees\ntime: {duration: 1, intervals: 12}\nends: {initial: {base: 0, arm: 0}, final: {base: 40, arm: 60}}\nobjective: [{term: acceleration, weight: 1}]\n' >reach.yaml
  "$AMBULO" solve reach.yaml -o robot -q
} 2>/dev/null
# a name that would end the script it stands in, and begin an element
evil='a<\/script><b>\\u2028\\"'"'"'\&ü'
sed -i "0,/\"problem\": \"walk\"/s//\"problem\": \"$evil\"/" walk/summary.json
for name in muscles failed study axes front robot; do
  check "ambulo report $name" "$AMBULO" report $name -o $name.html >/dev/null
done
check "ambulo report of two" "$AMBULO" report walk "brisk<b>" -o walk.html >/dev/null
# eight of the largest that are shipped
"$AMBULO" solve "$models/walk_whole_body_45.yaml" -o large -q 2>/dev/null
check "ambulo report of eight" "$AMBULO" report large large large large large large large large \
  -o eight.html >/dev/null
for name in walk muscles failed study axes front robot eight; do
  check "$name.html: $(wc -c <$name.html) bytes, expected at most 1200000" \
    [ "$(wc -c <$name.html)" -le 1200000 ]
done

if [ -z "$browser" ]; then
  echo 'skipped without chromium: the page in a browser (make check-page)'
  echo "$passed passed, $failed failed"
  [ "$failed" = 0 ]
  exit
fi

# ------------------------------------------------------ in a browser

# page KIND FILE: the page with what watches it first and what uses it last
page() {
  awk -v kind="$1" -v first="$here/watch.js" -v last="$here/checks.js" '
    function put(file, line) { while ((getline line < file) > 0) print line; close(file) }
    { print }
    /^<meta charset/ { print "<script>window.kind = \"" kind "\";"; put(first); print "</script>" }
    /^<\/body>/ && !done { done = 1 }
    END { print "<script>"; put(last); print "</script>" }' "$2"
}
for kind in walk muscles failed study axes front robot; do page $kind $kind.html >"$kind-test.html"; done
# cases as their own folders have them; their names are those of the folders
{
  sed '/^<meta charset/q' study-test.html
  echo '<script>window.own = ['
  for scene in study/cases/*/*/scene.json; do
    sed "1s/^{/{\"row\": \"$(basename "$(dirname "$scene")")\",/" "$scene"
    echo ','
  done
  echo '];</script>'
  sed '1,/^<meta charset/d' study-test.html
} >with-own.html && mv with-own.html study-test.html
"$AMBULO" report "brisk<b>" -o brisk.html >/dev/null
page flat brisk.html >flat-test.html
cat >all.html <<'END'
<!doctype html><meta charset="utf-8"><style>iframe { vertical-align: top }</style>
<iframe width="640" height="480" src="walk-test.html#t=0.1&theme=light"></iframe>
<iframe width="390" height="480" src="muscles-test.html#t=0.1"></iframe>
<iframe width="480" height="400" src="failed-test.html"></iframe>
<iframe width="480" height="400" src="study-test.html#t=0.3"></iframe>
<iframe width="480" height="400" src="front-test.html"></iframe>
<iframe width="480" height="400" src="axes-test.html"></iframe>
<iframe width="400" height="400" src="robot-test.html#t=0.3"></iframe>
<iframe width="400" height="400" src="flat-test.html#webgl=0"></iframe>
END
: >browser.log
"$browser" --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
  --ignore-gpu-blocklist --disable-extensions --no-first-run --disable-renderer-backgrounding \
  --disable-backgrounding-occluded-windows --user-data-dir="$work/profile" \
  --remote-debugging-port=0 --enable-logging=stderr --window-size=1700,1300 \
  "file://$work/all.html" >>browser.log 2>&1 &
running=$!
trap 'kill "$running" 2>/dev/null; wait "$running" 2>/dev/null; rm -rf "$work"' EXIT
for _ in $(seq 1200); do # at most two minutes
  [ "$(grep -c 'check: end ' browser.log)" -lt 8 ] && kill -0 "$running" 2>/dev/null || break
  sleep 0.1
done
results=$(sed -n 's/.*CONSOLE[^"]*"check: \(.*\)", source: .*/\1/p' browser.log)
while IFS= read -r line; do
  case $line in
  'ok '*) passed=$((passed + 1)) ;;
  'FAILED '*)
    failed=$((failed + 1))
    echo "$line"
    ;;
  esac
done <<<"$results"
for kind in walk muscles failed study axes front robot flat; do
  check "the checks of $kind come to their end" grep -q "^end $kind" <<<"$results"
done
[ "$failed" = 0 ] || grep CONSOLE browser.log | grep -v 'check: ' | tail -n 5
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
