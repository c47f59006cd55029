#!/usr/bin/env bash
# Kills a study again and again at random moments, resumes it in random ways, and checks that the
# results are those of an undisturbed run, bit for bit, and that nothing stored is ever lost.
#
#   tests/kill_and_resume.sh PROGRAM CONFIG [KILLS] [OPTIONS OF run...]
#   tests/kill_and_resume.sh build/release/bin/driftscope configs/study.toml 20 --runs 200
#
# KILLS (default 20) is the number of kill -9; they hit plain runs of 1 to 8 threads, workers i/4, and
# mpirun (the whole job, or one rank) where it is installed. RANDOM_SEED=n for another sequence.
set -uo pipefail

program=$1 config=$2 kills=${3:-20}
shift $(($# < 3 ? $# : 3))
options=("$@")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
seed=${RANDOM_SEED:-1}
RANDOM=$seed
mpi=(mpirun --allow-run-as-root --oversubscribe --bind-to none)
command -v mpirun >/dev/null || mpi=()

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
study() { "$program" run "$config" "${options[@]}" --progress none -o "$@"; }
digest() { "$program" verify "$1" --sample 0% | sed -n 's/^results //p'; }
stored() { "$program" status "$1" 2>/dev/null | sed -n '1s/.*: \([0-9]*\) of .*/\1/p'; }

expect_same() {  # WHAT FOLDER
  local got
  got=$(digest "$2") || fail "$1: verify does not accept the folder"
  [ "$got" = "$reference" ] || fail "$1: results $got, expected $reference"
  echo "same results: $1"
}

started=$(date +%s.%N)
study "$scratch/reference" --threads 1 >/dev/null 2>"$scratch/log"
code=$?
[ $code -eq 0 ] || [ $code -eq 5 ] || { cat "$scratch/log" >&2; fail "the undisturbed run ends with $code"; }
took=$(awk -v a="$started" -v b="$(date +%s.%N)" 'BEGIN { print b - a }')
reference=$(digest "$scratch/reference")
[ -n "$reference" ] || fail "no digest of the undisturbed run"
echo "reference: $reference, $took s with 1 thread"

for threads in 2 3 8; do
  study "$scratch/t$threads" --threads $threads >/dev/null 2>&1
  expect_same "$threads threads" "$scratch/t$threads"
done
for i in 0 1 2 3; do study "$scratch/workers" --worker $i/4 --threads 1 >/dev/null 2>&1 & done
wait
expect_same "4 workers" "$scratch/workers"
if [ ${#mpi[@]} -gt 0 ]; then
  for n in 1 2 3; do
    "${mpi[@]}" -n $n "$program" run "$config" "${options[@]}" --progress none -o "$scratch/mpi$n" --threads 1 >/dev/null 2>"$scratch/log"
    code=$?
    [ $code -eq 0 ] || [ $code -eq 5 ] || { cat "$scratch/log" >&2; fail "mpirun -n $n ends with $code"; }
    expect_same "mpirun -n $n" "$scratch/mpi$n"
  done
fi

# Ends a process and its descendants, or for one rank of mpirun only that.
end_all() {  # PID
  local child
  for child in $(pgrep -P "$1"); do end_all "$child"; done
  kill -9 "$1" 2>/dev/null
}
one_rank() {  # PID OF mpirun
  local ranks
  mapfile -t ranks < <(pgrep -P "$1")
  [ ${#ranks[@]} -gt 0 ] && kill -9 "${ranks[RANDOM % ${#ranks[@]}]}" 2>/dev/null
}

# Most of the time of a killed study is spent waiting for its end: several are killed beside each other.
kill_again() {  # PART KILLS, in a shell of its own
  local kills=$2 done_kills=0 round=0
  RANDOM=$((seed + $1))
  while [ $done_kills -lt "$kills" ]; do
    round=$((round + 1))
    folder=$scratch/killed$1.$round
    before=0
    while [ $done_kills -lt "$kills" ]; do
      kind=$((RANDOM % 3)) rank=0
      [ ${#mpi[@]} -eq 0 ] && kind=$((RANDOM % 2))
      case $kind in
        0) study "$folder" --threads $((1 + RANDOM % 8)) >/dev/null 2>&1 & ;;
        1) study "$folder" --worker $((RANDOM % 4))/4 --threads $((1 + RANDOM % 3)) >/dev/null 2>&1 & ;;
        2) rank=$((RANDOM % 2))
           "${mpi[@]}" -n $((1 + RANDOM % 3)) "$program" run "$config" "${options[@]}" --progress none -o "$folder" --threads 1 >/dev/null 2>&1 & ;;
      esac
      pid=$!
      # Up to a fifth of the whole time, so that a study takes several kills.
      sleep "$(awk -v t="$took" -v r=$RANDOM -v m=$kind 'BEGIN { print (m == 2 ? 0.3 : 0.02) + t / 5 * r / 32768 }')"
      if kill -0 $pid 2>/dev/null; then
        # A subshell of bash stands between for kinds 0 and 1: its children are ended first.
        if [ $kind = 2 ] && [ $rank = 1 ]; then one_rank $pid; else end_all $pid; fi
        done_kills=$((done_kills + 1))
      fi
      # An mpirun whose rank was killed may wait for ever by itself: it is ended after a minute.
      (sleep 60; kill -9 $pid) >/dev/null 2>&1 </dev/null &
      watch=$!
      wait $pid 2>/dev/null
      kill -9 $watch 2>/dev/null  # a mere TERM, right after the fork, would run the trap of this shell there
      wait $watch 2>/dev/null
      if [ -e "$folder/manifest.json" ]; then
        now=$(stored "$folder")
        [ -n "$now" ] || fail "part $1, round $round: status does not read the folder after a kill"
        [ "$now" -ge "$before" ] || fail "part $1, round $round: $before runs were stored, $now after the kill"
        [ "$now" -gt "$before" ] && before=$now
      fi
      [ "$before" = "$(stored "$scratch/reference")" ] && break
    done
    study "$folder" >/dev/null 2>"$scratch/log$1"
    code=$?
    [ $code -eq 0 ] || [ $code -eq 5 ] || { cat "$scratch/log$1" >&2; fail "the last resume ends with $code"; }
    expect_same "killed and resumed, $done_kills kills of part $1 so far" "$folder"
    "$program" verify "$folder" --sample 5% >/dev/null || fail "part $1, round $round: verify finds fault"
  done
}
parts=4
for ((part = 1; part <= parts; part++)); do
  (kill_again $part $(((kills + part - 1) / parts))) &
  pids[part]=$!
done
for ((part = 1; part <= parts; part++)); do wait "${pids[part]}" || fail "part $part, above"; done
echo "$kills kills, 0 runs lost, all results equal"
