#!/bin/sh
# Mechanics, solves and robots beside other programs, in one run on one core: `make bench-peers`.
#
# Needs Python with venv, a network for pip the first time, and a C++ compiler; says plainly what
# is missing and then ends without failure. Everything is built below $OUT/peers.
#   MODEL         model of 18 coordinates (models/yardstick_body.yaml)
#   ROUNDS        how often the programs take turns (7)
#   PEERS_VENV    a virtual environment that has already what `.setup/install.sh peers` installs
#   CORE          the core to run on (the last one), where the system lets us choose
#   AMBULO_PEERS  folder of gait_ipopt.py, the yardstick by CasADi + IPOPT (../shared/peers)
set -eu
OUT=${OUT:-build}
MODEL=${MODEL:-models/yardstick_body.yaml}
ROUNDS=${ROUNDS:-7}
AMBULO_PEERS=${AMBULO_PEERS:-../shared/peers}
work=$OUT/peers
venv=${PEERS_VENV:-build/python-venv}
here=bench/peers
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
mkdir -p "$work"

without() {
  echo "bench-peers: $1; the comparison is left out"
  exit 0
}
has() { command -v "$1" >/dev/null 2>&1; }
core=${CORE:-$(($(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1) - 1))}
on_core() { if has taskset; then taskset -c "$core" "$@"; else "$@"; fi; }
newer() { [ ! -e "$1" ] || [ "$2" -nt "$1" ] || [ "$here/timing.h" -nt "$1" ]; }

# -------------------------------------------------------------- environment

has python3 || without 'python3 is not installed'
if [ -z "${PEERS_VENV:-}" ]; then
  .setup/install.sh peers >"$work/pip.log" 2>&1 ||
    without "pip cannot install what it is compared with (see $work/pip.log)"
fi
python=$venv/bin/python
prefix=$("$python" -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')/cmeel.prefix
if has clang++; then cxx=clang++; elif has c++; then cxx=c++; else without 'no C++ compiler'; fi
if grep -qs avx512dq /proc/cpuinfo; then lanes=8; elif grep -qs avx2 /proc/cpuinfo; then lanes=4
else without 'the processor has no AVX2, which the code in lanes needs'; fi

# ----------------------------------------------------------------- programs

"$OUT/bench/peers/ours" write "$MODEL" "$work"
if newer "$work/pinocchio" $here/pinocchio.cpp; then
  echo "building Pinocchio's program with $cxx -O3 -march=native (about a minute)"
  $cxx -w -std=c++17 -DNDEBUG -O3 -march=native -DBOOST_MPL_LIMIT_LIST_SIZE=30 \
    -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
    -DBOOST_FUSION_INVOKE_MAX_ARITY=12 -I"$prefix/include" -I"$prefix/include/eigen3" \
    -Iinclude -Ibench -I$here $here/pinocchio.cpp -o "$work/pinocchio"
fi
if newer "$work/casadi_lanes" $here/casadi_lanes.py || [ $here/casadi_lanes.c -nt "$work/casadi_lanes" ] ||
  ! cmp -s "$work/model.txt" "$work/casadi_model.txt"; then
  echo "building CasADi's code in $lanes lanes"
  "$python" $here/casadi_lanes.py "$work"
  gcc -std=gnu11 -O3 -march=native -DLANES=$lanes -I"$work" -Iinclude -Ibench -I$here \
    $here/casadi_lanes.c -o "$work/casadi_lanes" -lmvec -lm
  cp "$work/model.txt" "$work/casadi_model.txt"
fi

# ---------------------------------------------------------------- mechanics

: >"$work/times.txt"
round=0
while [ "$round" -lt "$ROUNDS" ]; do
  round=$((round + 1))
  on_core "$OUT/bench/peers/ours" time "$MODEL" >>"$work/times.txt"
  on_core "$work/casadi_lanes" "$work" >>"$work/times.txt"
  on_core "$work/pinocchio" "$work" >>"$work/times.txt"
done
echo
echo "mechanics of $MODEL, ns per time node on one core: medians of $ROUNDS rounds, and the least of"
echo "them, which is what it takes when nothing else is going on"
echo "(Pinocchio by $cxx -O3 native; CasADi's C in $lanes lanes by gcc -O3 native)"
machine=$("$OUT/bench/peers/ours" folder)
mkdir -p "bench/results/$machine"
sort -k1,1 -k2,2 -k3,3n "$work/times.txt" | awk -v csv="bench/results/$machine/peers.csv" '
  { key = $1 " " $2; count[key]++; value[key, count[key]] = $3 }
  function time_of(key, least) { return value[key, least ? 1 : int((count[key] + 1) / 2)] }
  function put(name, unit, number, least) {
    print name (least ? " at least" : "") "," unit "," number >csv
  }
  function report(quantity, least,   p, ours, ratio, lanes) {
    printf "%-20s", quantity (least ? ", least" : "")
    for (p = 1; p <= programs; p++) {
      printf "%20.1f", time_of(program[p] " " quantity, least)
      put(program[p] " " quantity, "ns/node", time_of(program[p] " " quantity, least), least)
    }
    ours = time_of("ambulo " quantity, least)
    ratio = time_of("pinocchio " quantity, least) / ours
    lanes = time_of("casadi_lanes " quantity, least) / ours
    printf "%18.1f%18.2f\n", ratio, lanes
    put("pinocchio over ambulo " quantity, "ratio", ratio, least)
    put("casadi_lanes over ambulo " quantity, "ratio", lanes, least)
  }
  END {
    programs = split("ambulo ambulo_with_points casadi_lanes pinocchio", program, " ")
    split("tau tau+vjp jacobians", quantities, " ")
    print "quantity,unit,value" >csv
    printf "%-20s", ""
    for (p = 1; p <= programs; p++) printf "%20s", program[p]
    printf "%18s%18s\n", "pinocchio/ambulo", "casadi/ambulo"
    for (k = 1; k <= 3; k++) report(quantities[k], 0)
    for (k = 1; k <= 3; k++) report(quantities[k], 1)
  }'

# ------------------------------------------------------------------- solves

echo
if [ -f "$AMBULO_PEERS/gait_ipopt.py" ]; then
  echo 'yardstick from zero, processor seconds: CasADi + IPOPT with exact Hessians, and ambulo'
  GAIT_GEN=$work on_core "$python" $here/ipopt.py "$AMBULO_PEERS" "$OUT/ambulo" models 12 36 72
else
  echo "no gait_ipopt.py in $AMBULO_PEERS (set AMBULO_PEERS): the comparison with IPOPT is left out"
fi

# ------------------------------------------------------------------- robots

echo
echo 'two steps of two robots from rest, the least of three: Crocoddyl, by its own example for bipeds, and ambulo'
"$OUT/ambulo" import tests/users/biped.urdf >/dev/null 2>&1 || without 'this build cannot import a URDF'
on_core "$python" $here/robots.py "$OUT/ambulo" tests/users/biped.urdf "$work" "bench/results/$machine/robots.csv"
