#!/bin/sh
# Mechanics and solves beside other programs, in one run on one core: `make bench-peers`.
#
# Needs Python with venv, a network for pip the first time, and a C++ compiler; says plainly what
# is missing and then ends without failure. Everything is built below $OUT/peers.
#   MODEL         model of 18 coordinates (models/yardstick_body.yaml)
#   ROUNDS        how often the programs take turns (3); medians are reported
#   PEERS_VENV    a virtual environment that has pin, cmeel-eigen, casadi and numpy already
#   AMBULO_PEERS  folder of gait_ipopt.py, the yardstick by CasADi + IPOPT (../shared/peers)
set -eu
OUT=${OUT:-build}
MODEL=${MODEL:-models/yardstick_body.yaml}
ROUNDS=${ROUNDS:-3}
AMBULO_PEERS=${AMBULO_PEERS:-../shared/peers}
work=$OUT/peers
venv=${PEERS_VENV:-$work/venv}
here=bench/peers
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
mkdir -p "$work"

without() {
  echo "bench-peers: $1; the comparison is left out"
  exit 0
}
has() { command -v "$1" >/dev/null 2>&1; }
# one core, the last one, where the system lets us choose
core=$(($(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1) - 1))
on_core() { if has taskset; then taskset -c "$core" "$@"; else "$@"; fi; }
newer() { [ ! -e "$1" ] || [ "$2" -nt "$1" ] || [ "$here/timing.h" -nt "$1" ]; }

# -------------------------------------------------------------- environment

has python3 || without 'python3 is not installed'
if [ ! -x "$venv/bin/python" ]; then
  python3 -m venv "$venv" >"$work/venv.log" 2>&1 ||
    { rm -rf "$venv"; without "python3 -m venv does not work (see $work/venv.log)"; }
fi
python=$venv/bin/python
"$python" -c 'import casadi, numpy, pinocchio, scipy' 2>/dev/null ||
  "$venv/bin/pip" install -q pin cmeel-eigen casadi numpy scipy >"$work/pip.log" 2>&1 ||
  without "pip cannot install pin, cmeel-eigen, casadi, numpy and scipy (see $work/pip.log)"
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
echo "mechanics of $MODEL, ns per time node on one core, medians of $ROUNDS rounds"
echo "(Pinocchio by $cxx -O3 native; CasADi's C in $lanes lanes by gcc -O3 native)"
machine=$("$OUT/bench/peers/ours" folder)
mkdir -p "bench/results/$machine"
sort -k1,1 -k2,2 -k3,3n "$work/times.txt" | awk -v csv="bench/results/$machine/peers.csv" '
  { key = $1 " " $2; count[key]++; value[key, count[key]] = $3 }
  function median(key) { return value[key, int((count[key] + 1) / 2)] }
  END {
    programs = split("ambulo ambulo_with_points casadi_lanes pinocchio", program, " ")
    split("tau tau+vjp jacobians", quantity, " ")
    print "quantity,unit,median" >csv
    printf "%-12s", ""
    for (p = 1; p <= programs; p++) printf "%20s", program[p]
    printf "%18s%18s\n", "pinocchio/ambulo", "casadi/ambulo"
    for (k = 1; k <= 3; k++) {
      printf "%-12s", quantity[k]
      for (p = 1; p <= programs; p++) {
        key = program[p] " " quantity[k]
        printf "%20.1f", median(key)
        print key ",ns/node," median(key) >csv
      }
      ours = median("ambulo " quantity[k])
      ratio = median("pinocchio " quantity[k]) / ours
      lanes = median("casadi_lanes " quantity[k]) / ours
      printf "%18.1f%18.2f\n", ratio, lanes
      print "pinocchio over ambulo " quantity[k] ",ratio," ratio >csv
      print "casadi_lanes over ambulo " quantity[k] ",ratio," lanes >csv
    }
  }'

# ------------------------------------------------------------------- solves

echo
if [ -f "$AMBULO_PEERS/gait_ipopt.py" ]; then
  echo 'yardstick from zero, processor seconds: CasADi + IPOPT with exact Hessians, and ambulo'
  GAIT_GEN=$work on_core "$python" $here/ipopt.py "$AMBULO_PEERS" "$OUT/ambulo" models 12 36 72
else
  echo "no gait_ipopt.py in $AMBULO_PEERS (set AMBULO_PEERS): the comparison with IPOPT is left out"
fi
