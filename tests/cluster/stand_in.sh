#!/usr/bin/env bash
# The job script for arrays of Slurm under a stand-in for the scheduler: four tasks, each ended before its
# time is up, one by a signal to its shell alone, and queued again until all is done. The results are
# those of one process.
#
#   tests/cluster/stand_in.sh PROGRAM CONFIG
set -uo pipefail
. "$(dirname "$0")/common.sh"

mkdir "$scratch/bin"
printf '#!/bin/sh\n[ "$1" = requeue ] && : >"%s/queue.${2#*_}"\n' "$scratch" >"$scratch/bin/scontrol"
chmod +x "$scratch/bin/scontrol"
export PATH="$scratch/bin:$PATH" DRIFTSCOPE=$program MAX_WALL=1s SLURM_CPUS_PER_TASK=1
export SLURM_ARRAY_JOB_ID=1 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=4 SLURM_ARRAY_TASK_COUNT=4 SLURM_ARRAY_TASK_STEP=1

task() {  # ID: in the background, as the process that a signal is sent to
  export SLURM_ARRAY_TASK_ID=$1
  exec bash "$jobs/slurm_array.sh" "$config" "$scratch/out" >"$scratch/log.$1" 2>&1
}

task 1 & signalled=$!
sleep 0.4
kill -TERM $signalled
wait $signalled
[ -e "$scratch/queue.1" ] || { cat "$scratch/log.1" >&2; fail "a task that was sent SIGTERM was not queued again"; }
"$program" status "$scratch/out" >/dev/null
[ $? -eq 75 ] || fail "status of a study with parts missing is not 75"

: >"$scratch/queue.2"; : >"$scratch/queue.3"; : >"$scratch/queue.4"
requeues=0
for ((round = 0; round < 40; ++round)); do
  waiting=("$scratch"/queue.*)
  [ -e "${waiting[0]}" ] || break
  export MAX_WALL=$((1 + round / 5))s  # however slow the machine, once it is enough
  for file in "${waiting[@]}"; do
    rm "$file"
    task "${file##*.}" &
    requeues=$((requeues + 1))
  done
  wait
done
[ $requeues -gt 4 ] || fail "no task was queued again for time"
"$program" status "$scratch/out" >/dev/null || fail "status after the last task: $?"
run_reference
[ "$(digest "$scratch/out")" = "$reference" ] ||
  fail "results of the array are not those of one process"

for i in 0 1; do "$program" run "$config" -o "$scratch/part$i" --worker $i/2 --progress none >/dev/null 2>&1; done
cp "$scratch"/part1/worker-0001.sqlite "$scratch/part0/"
"$program" status "$scratch/part0" >/dev/null || fail "a folder with the worker files of both parts is not complete"
[ "$(digest "$scratch/part0")" = "$reference" ] || fail "merged folders differ from one process"

SLURM_STEP_NUM_TASKS=4 SLURM_PROCID=0 "$program" run "$config" -o "$scratch/alone" >/dev/null 2>"$scratch/said"
[ $? -eq 2 ] && grep -q 'worker auto' "$scratch/said" || fail "srun without MPI was not refused"
echo "an array of 4, $requeues times started anew: the results of one process"
