#!/usr/bin/env bash
# configs/cluster/slurm_array.sh and slurm_mpi.sh under a real Slurm: eight tasks that end for time and are
# queued again, one by a signal, the whole node killed at work; ranks of MPI; the tasks of srun. The
# results are those of one process.
#
#   tests/cluster/slurm.sh PROGRAM CONFIG [KILLS] [OPTIONS OF run...]
#
# KILLS (default 2): how often the node is killed, KILL_EVERY seconds (default 2) apart or more. MAX_WALL
# (default 3s) as in slurm_array.sh. KEEP=folder: where the results go. ARRAY_ALONE=1: without MPI and srun.
# 77 where there is no Slurm and none can be fetched.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
kills=${3:-2}
shift $(($# < 3 ? $# : 3))
results=${KEEP:-$scratch}
mkdir -p "$results"
. "$here/local_slurm.sh"
trap 'slurm_down; rm -rf "$scratch"' EXIT
fail() {
  echo "FAILED: $*" >&2
  tail -n 20 "$scratch"/log.* "$scratch/slurm/log/ctld.log" >&2
  exit 1
}
queued() { squeue -h -o %T 2>/dev/null | wc -l; }
seconds() { awk -v a="$1" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'; }

slurm_up "$scratch/slurm" || { echo "skipped: $slurm_missing"; exit 77; }
export DRIFTSCOPE=$program MAX_WALL=${MAX_WALL:-3s} LD_LIBRARY_PATH

cd "$scratch"
submit() { sbatch --parsable --chdir="$scratch" --output="$scratch/log.%A_%a" --open-mode=append --requeue "$@"; }
started=$(date +%s.%N)
array=$(submit --array=0-7 --cpus-per-task=1 --time=60 --signal=B:TERM@120 "$jobs/slurm_array.sh" "$config" "$results/array") ||
  fail "sbatch refuses the array"
killed=0 signalled=0
while [ "$(queued)" -gt 0 ]; do
  running=$(squeue -h -t running -o %i | head -n 1)
  if [ $signalled -eq 0 ] && [ -n "$running" ] && [ -e "$results/array/manifest.json" ]; then
    scancel --signal=TERM --batch "$running" && signalled=1
  elif [ $killed -lt "$kills" ] && [ "$(squeue -h -t running -o %i | wc -l)" -ge 2 ] &&
    [ "$(find "$results/array" -name 'worker-*.sqlite' 2>/dev/null | wc -l)" -ge 2 ] &&
    [ "$(seconds "$started" | cut -d. -f1)" -ge $((${KILL_EVERY:-2} * (killed + 1))) ]; then
    slurm_kill_node
    killed=$((killed + 1))
    "$program" status "$results/array" >"$scratch/status" 2>&1
    [ $? -eq 75 ] || fail "status after kill $killed of the node is not 75: $(cat "$scratch/status")"
    scontrol update nodename="$(hostname)" state=down reason=killed
    sleep 1
    slurm_start_node || fail "the node does not come back"
    echo "the node is killed: $(head -n 1 "$scratch/status")"
  fi
  scontrol release "$array" >/dev/null 2>&1  # what a dead node gave back may be held
  [ "$(seconds "$started" | cut -d. -f1)" -lt "${LONGEST:-900}" ] || fail "the queue does not become empty: $(squeue)"
  sleep 0.5
done
took=$(seconds "$started")
starts=$(cat "$scratch"/log.* | grep -c 'results go to')
[ $killed -eq "$kills" ] || fail "the node was killed $killed times of $kills: the study is too short"
[ $signalled -eq 1 ] || fail "no task was sent a signal"
[ "$starts" -gt 8 ] || fail "no task was queued again"
"$program" status "$results/array" >/dev/null || fail "status after the last task: $?"

started=$(date +%s.%N)
"$program" run "$config" -o "$results/reference" --progress none >/dev/null 2>&1
alone=$(seconds "$started")
reference=$(digest "$results/reference")
[ -n "$reference" ] && [ "$(digest "$results/array")" = "$reference" ] || fail "results of the array are not those of one process"
echo "an array of 8, $starts starts, $kills kills of the node: the results of one process ($took s; alone $alone s)"
[ -z "${ARRAY_ALONE:-}" ] || exit 0

submit --wait --ntasks=4 --cpus-per-task=1 --time=10 --wrap \
  "exec srun --ntasks=4 '$program' run '$config' -o '$results/tasks' --worker auto --threads 1 --progress none" >/dev/null ||
  fail "four tasks of srun end with $?"
[ "$(digest "$results/tasks")" = "$reference" ] || fail "results of srun --worker auto are not those of one process"
echo "srun --ntasks=4, --worker auto: the same"

if srun --mpi=list 2>&1 | grep -q pmix && "$program" version 2>/dev/null | grep -q '^MPI  *[0-9]'; then
  MAX_WALL=10m submit --wait --ntasks=3 --cpus-per-task=1 --time=10 "$jobs/slurm_mpi.sh" "$config" "$results/mpi" >/dev/null ||
    fail "slurm_mpi.sh ends with $?"
  [ "$(digest "$results/mpi")" = "$reference" ] || fail "results of 3 ranks are not those of one process"
  [ "$(ls "$results"/mpi/worker-*.sqlite | wc -l)" -eq 3 ] || fail "the ranks did not share the work"
  echo "slurm_mpi.sh with 3 ranks: the same"
else
  echo "no MPI: Slurm or the program is without"
fi
