#!/usr/bin/env bash
# A study on a file system that has no locks: three workers at once give what one process gives where there
# are locks, kill -9 amid a transaction loses nothing, every command reads the folder, and a second process
# is kept from a worker's file.
#
#   tests/no_locks.sh PROGRAM FAULTS CONFIG [KILLS]
#
# FAULTS is the library of tests/support/fault_injection.cpp.
set -uo pipefail
program=$1 faults=$2 config=$3 kills=${4:-12}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
RANDOM=${RANDOM_SEED:-1}
fail() {
  echo "FAILED: $*" >&2
  cat "$scratch"/said* >&2
  exit 1
}
# A prefix, not a function: a function in the background is a shell, and the kill would hit that.
without_locks=(env "LD_PRELOAD=$faults" DRIFT_NO_LOCKS=1)
digest() { "$@" --sample 5% 2>"$scratch/said" | sed -n 's/^results //p'; }
ends_well() { [ "$1" -eq 0 ] || [ "$1" -eq 5 ]; }

"$program" run "$config" -o "$scratch/reference" --progress none >/dev/null 2>"$scratch/said"
ends_well $? || fail "the study with locks"
reference=$(digest "$program" verify "$scratch/reference")
[ -n "$reference" ] || fail "no digest of the study with locks"

# Three at once.
pids=()
for i in 0 1 2; do
  "${without_locks[@]}" "$program" run "$config" -o "$scratch/three" --worker $i/3 --threads 1 --progress none >/dev/null 2>"$scratch/said$i" &
  pids+=($!)
done
for pid in "${pids[@]}"; do wait "$pid"; ends_well $? || fail "a worker without locks"; done
grep -q 'this file system has no locks' "$scratch/said0" || fail "nobody was told that there are no locks"
[ "$(digest "${without_locks[@]}" "$program" verify "$scratch/three")" = "$reference" ] || fail "three workers gave other results"
for read in "status" "verify" "report" "export --format csv" "export --format hdf5"; do
  # shellcheck disable=SC2086
  set -- $read
  "${without_locks[@]}" "$program" "$1" "$scratch/three" "${@:2}" >/dev/null 2>"$scratch/said" || fail "$read without locks: exit $?"
done
grep -q damage "$scratch"/said* && fail "something was called damaged"
ls "$scratch"/three/*.holder.lock 2>/dev/null && fail "a worker that ended still holds its file"

# Killed again and again, read in between.
folder=$scratch/killed before=0
for ((k = 0; k < kills || (before == 0 && k < 4 * kills); ++k)); do
  "${without_locks[@]}" "$program" run "$config" -o "$folder" --threads 1 --progress none >/dev/null 2>"$scratch/said" &
  pid=$!
  sleep "$(awk -v k=$k -v r=$RANDOM 'BEGIN { print 0.1 + (k + 1) * 0.2 * r / 32768 }')"  # later and later: a busy machine is slow
  kill -9 $pid 2>/dev/null
  wait $pid 2>/dev/null
  [ -e "$folder/manifest.json" ] || continue
  "${without_locks[@]}" "$program" status "$folder" >"$scratch/status" 2>"$scratch/said"
  grep -q damage "$scratch/status" && fail "kill $k: $(cat "$scratch/status")"
  now=$(sed -n '1s/.*: \([0-9]*\) of .*/\1/p' "$scratch/status")
  [ -n "$now" ] && [ "$now" -ge "$before" ] || fail "kill $k: $before runs were stored, now ${now:-none}"
  before=$now
done
[ "$before" -gt 0 ] || fail "no kill came after the first transaction"
"${without_locks[@]}" "$program" run "$config" -o "$folder" --progress none >/dev/null 2>"$scratch/said"
ends_well $? || fail "not resumed without locks"
[ "$(digest "${without_locks[@]}" "$program" verify "$folder")" = "$reference" ] || fail "killed and resumed: other results"
[ "$(digest "$program" verify "$folder")" = "$reference" ] || fail "read where there are locks: other results"

# The half of a transaction that a killed writer left: read with it, and undone.
half=$scratch/half
cp -r "$folder" "$half"
python3 - "$half/worker-0000.sqlite" <<'PYTHON'
import os, sqlite3, sys
if os.fork() == 0:
    db = sqlite3.connect(sys.argv[1], isolation_level=None)
    db.execute("PRAGMA cache_size=1"); db.execute("PRAGMA synchronous=OFF"); db.execute("BEGIN IMMEDIATE")
    db.execute("DELETE FROM blocks WHERE id > 1"); db.execute("UPDATE blocks SET payload = zeroblob(length(payload))")
    os._exit(0)
os.wait()
PYTHON
[ -s "$half/worker-0000.sqlite-journal" ] || fail "no half of a transaction to undo"
[ "$(digest "${without_locks[@]}" "$program" verify "$half")" = "$reference" ] || fail "half of a transaction was read"

# One process at a time is a worker, and one of another machine is asked about.
"${without_locks[@]}" "$program" run "$config" -o "$scratch/twice" --threads 1 --progress none >/dev/null 2>&1 & pid=$!
for ((i = 0; i < 100; ++i)); do [ -e "$scratch/twice/worker-0000.holder.lock" ] && break; sleep 0.05; done
kill -STOP $pid
"${without_locks[@]}" "$program" run "$config" -o "$scratch/twice" --threads 1 --progress none >/dev/null 2>"$scratch/said"
[ $? -eq 7 ] && grep -q 'is at work' "$scratch/said" || fail "a second process took a worker's file"
kill -9 $pid
wait $pid 2>/dev/null
printf '0a0a0a0a-0b0b0b0b-0c0c0c0c-1-1\nprocess 1 on node7 since 2026-01-01T00:00:00Z\n' >"$scratch/twice/worker-0000.holder.lock"
"${without_locks[@]}" "$program" run "$config" -o "$scratch/twice" --threads 1 --progress none >/dev/null 2>"$scratch/said"
[ $? -eq 7 ] && grep -q 'process 1 on node7.*remove this file' "$scratch/said" || fail "a holder on another machine was passed over"
rm "$scratch/twice/worker-0000.holder.lock"
"${without_locks[@]}" "$program" run "$config" -o "$scratch/twice" --progress none >/dev/null 2>"$scratch/said"
ends_well $? && [ "$(digest "$program" verify "$scratch/twice")" = "$reference" ] || fail "not resumed after the holder was removed"
echo "no locks: 3 workers, $kills kills: the results of one process with locks"
