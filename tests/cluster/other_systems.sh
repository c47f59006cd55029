#!/usr/bin/env bash
# configs/cluster/gnu_parallel.sh under GNU parallel, and what configs/cluster/htcondor.sub says, done as
# HTCondor would do it: every job in a folder of its own with its input, its executable and arguments, again
# where it ends with the exit code of a checkpoint, its output remapped; then merged as the file says.
#
#   tests/cluster/other_systems.sh PROGRAM CONFIG
#
# 77 where there is no GNU parallel and it cannot be fetched; HTCondor's part is shown all the same.
set -uo pipefail
. "$(dirname "$0")/common.sh"
run_reference

# A value of the submit file, with its macros as job $1 sees them.
said() { sed -n "s/^$2 *= *//p" "$jobs/htcondor.sub" | sed "s/\$(Process)/$1/g"; }
count=$(sed -n 's/^queue //p' "$jobs/htcondor.sub")
[ "$(said 0 executable)" = /usr/bin/driftscope ] || fail "htcondor.sub runs $(said 0 executable)"
checkpoints=0
for ((id = 0; id < count; ++id)); do
  mkdir "$scratch/job$id"
  cd "$scratch/job$id" || exit 1
  cp "$config" "$(said $id transfer_input_files)"
  arguments=$(said $id arguments)
  [[ $arguments == *" 55m"* ]] || fail "htcondor.sub sets no time"
  for limit in 0.05s 55m; do  # the first start ends for time
    read -ra words <<<"${arguments/55m/$limit}"
    "$program" "${words[@]}" >out 2>err
    code=$?
    [ $code -eq "$(said $id checkpoint_exit_code)" ] || break
    [ -d "$(said $id transfer_checkpoint_files)" ] || fail "job $id has no checkpoint to transfer"
    checkpoints=$((checkpoints + 1))
  done
  [ $code -eq 0 ] || { cat err >&2; fail "job $id ends with $code"; }
  from_to=$(said $id transfer_output_remaps | tr -d '" ')
  [ "${from_to%%=*}" = "$(said $id transfer_output_files)" ] || fail "what is remapped is not what is transferred"
  mv "${from_to%%=*}" "$scratch/${from_to#*=}"
done
[ $checkpoints -gt 0 ] || fail "no job had to be started again"
cd "$scratch" || exit 1
[ "$(ls -d results.* | wc -l)" -eq "$count" ] || fail "not every job has its results"
mkdir merged
cp results.*/worker-*.sqlite merged/
cp results.0/manifest.json merged/
"$program" run "$config" -o merged --progress none >/dev/null 2>err || { cat err >&2; fail "run on the merged folder: $?"; }
[ "$(digest merged)" = "$reference" ] || fail "merged results of HTCondor's jobs are not those of one process"
echo "htcondor.sub: $count jobs, $checkpoints checkpoints, merged: the results of one process"

if ! command -v parallel >/dev/null; then
  (timeout 120 apt-get download parallel >apt.log 2>&1 && dpkg -x parallel_*.deb root) ||
    { echo "skipped: no GNU parallel, and its package cannot be fetched"; exit 77; }
  # Unpacked for this script, not installed.
  found=$(find "$scratch/root" -name parallel -type f -perm -u+x | head -n 1)
  export PATH=${found%/*}:$PATH
fi
parallel --version 2>/dev/null | grep -q 'GNU parallel' || { echo "skipped: parallel is not GNU parallel, or lacks perl"; exit 77; }
cp "$config" "$scratch/my study.toml"
HOME=$scratch DRIFTSCOPE=$program bash "$jobs/gnu_parallel.sh" "$scratch/my study.toml" "my results" 6 >said 2>&1 || { cat said >&2; fail "gnu_parallel.sh ends with $?"; }
[ "$(ls "my results"/worker-*.sqlite | wc -l)" -eq 6 ] || fail "not every part has its file"
[ "$(digest "my results")" = "$reference" ] || fail "results of gnu_parallel.sh are not those of one process"
echo "gnu_parallel.sh: 6 parts, names with blanks: the results of one process"
