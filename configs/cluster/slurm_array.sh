#!/usr/bin/env bash
#SBATCH --array=0-15 --cpus-per-task=4 --time=01:00:00 --requeue --open-mode=append
#SBATCH --signal=B:TERM@120 --output=driftscope.%A_%a.log
# One study, shared out among the tasks of an array; every task writes its own file.
#
#   sbatch configs/cluster/slurm_array.sh STUDY.toml RESULTS
#   driftscope run STUDY.toml -o RESULTS      afterwards: makes the report, and what is missing still
#
# A task that ends before its part is done (75: time, 143: signal) is queued again and goes on. DRIFTSCOPE
# names the program where it is not on the PATH.
${DRIFTSCOPE:-driftscope} run "$1" -o "$2" --worker auto --threads "${SLURM_CPUS_PER_TASK:-1}" \
  --max-wall "${MAX_WALL:-55m}" --progress plain &
program=$!
# The shell is what Slurm sends the signal to; it would end and leave the program to be killed.
trap 'kill -TERM "$program"' TERM
wait "$program"
code=$?
while kill -0 "$program" 2>/dev/null; do  # a trap ends the waiting, not the program
  wait "$program"
  code=$?
done
case $code in
  75 | 143) scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" ;;
  *) exit "$code" ;;
esac
