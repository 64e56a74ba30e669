#!/usr/bin/env bash
# One sweep as a whole run, as shards under GNU parallel, and as a Slurm array on this machine
# alone: three times the same table. What is not installed, or cannot start, is skipped.
# Slurm runs from a scratch folder with a configuration of its own, as root.
set -u
here=$(cd "$(dirname "$0")" && pwd)
AMBULO=$(realpath "${AMBULO:-$here/../../build/ambulo}")
SWEEP=$(realpath "${SWEEP:-$here/pendulums.yaml}")
export AMBULO SWEEP OPENBLAS_NUM_THREADS=1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ambulo-cluster-XXXXXX")
chmod 755 "$scratch"
daemons=()
trap '[ ${#daemons[@]} = 0 ] || kill "${daemons[@]}" 2>/dev/null; sleep 0.5; rm -rf "$scratch"' EXIT
passed=0 failed=0

same_table() { # folder, what it is, the folder of the whole run
  "$AMBULO" collect "$scratch/$1" && cmp "$scratch/${3:-whole}/results.csv" "$scratch/$1/results.csv"
  local status=$?
  echo "$2: exit status $status"
  if [ "$status" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

"$AMBULO" batch "$SWEEP" -o "$scratch/whole" --quiet && "$AMBULO" collect "$scratch/whole"

if command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q GNU; then
  seq 1 4 | parallel -j 2 "$AMBULO" batch "$SWEEP" -o "$scratch/parallel" -j 1 --quiet --shard '{}/4'
  same_table parallel 'GNU parallel'
else
  echo 'skipped: GNU parallel is not installed'
fi

start_slurm() {
  for tool in munged slurmctld slurmd sbatch sinfo; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; return 1; }
  done
  [ "$(id -u)" = 0 ] || { echo 'skipped: Slurm needs root here'; return 1; }
  local host state=$scratch/slurm
  host=$(hostname -s)
  mkdir -p "$state/ctld" "$state/d"
  dd if=/dev/urandom of="$state/key" bs=128 count=1 2>/dev/null
  chmod 400 "$state/key"
  munged --foreground --force --key-file="$state/key" --socket="$state/munge" \
    --pid-file="$state/munged.pid" --seed-file="$state/seed" --log-file="$state/munged.log" \
    >/dev/null 2>&1 &
  daemons+=($!)
  cat >"$state/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$state/munge
CredType=cred/munge
StateSaveLocation=$state/ctld
SlurmdSpoolDir=$state/d
SlurmctldPidFile=$state/slurmctld.pid
SlurmdPidFile=$state/slurmd.pid
SlurmctldLogFile=$state/slurmctld.log
SlurmdLogFile=$state/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=1
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES State=UP
CONF
  export SLURM_CONF=$state/slurm.conf
  sleep 1
  slurmctld -D -i >"$state/ctld.out" 2>&1 &
  daemons+=($!)
  slurmd -D >"$state/d.out" 2>&1 &
  daemons+=($!)
  for _ in $(seq 40); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && return 0
    sleep 0.5
  done
  echo "skipped: Slurm did not start: $(tail -qn 1 "$state"/*.out "$state"/*.log 2>/dev/null | tr '\n' ' ')"
  return 1
}

done_in() { "$AMBULO" batch --status "$1" 2>/dev/null | awk '/^done/ { print $2 }'; }

# cancelled in the middle, as at its time limit, and submitted again; walks, so that there is one
cancel_and_resume() {
  printf '%s\n' 'ambulo: 1' 'kind: sweep' 'name: walks' "base: $here/../../models/walk.yaml" \
    'axes:' '  - {key: subject.mass, name: mass, range: [56, 78, 1]}' 'outputs: [objective]' \
    >"$scratch/walks.yaml"
  SWEEP=$scratch/walks.yaml
  "$AMBULO" batch "$SWEEP" -o "$scratch/walks" --quiet && "$AMBULO" collect "$scratch/walks"
  local job
  job=$(cd "$scratch" && DIR=$scratch/cancelled sbatch --parsable --export=ALL "$here/slurm_array.sh")
  for _ in $(seq 400); do
    [ "$(done_in "$scratch/cancelled")" -ge 2 ] 2>/dev/null && break
    sleep 0.05
  done
  scancel "$job"
  while squeue -h -j "$job" 2>/dev/null | grep -q .; do sleep 0.2; done
  echo "cancelled after $(done_in "$scratch/cancelled") of 23 cases; accounts of the tasks:"
  cat "$scratch"/slurm-*.log
  (cd "$scratch" && DIR=$scratch/cancelled timeout 120 sbatch --wait --export=ALL "$here/slurm_array.sh")
  same_table cancelled 'Slurm array, cancelled and submitted again' walks
}

if start_slurm; then
  (cd "$scratch" && DIR=$scratch/array timeout 120 sbatch --wait --export=ALL "$here/slurm_array.sh")
  same_table array 'Slurm array'
  cancel_and_resume
fi
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
