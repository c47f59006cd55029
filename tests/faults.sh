#!/usr/bin/env bash
# Lets every single call that changes files fail once, in every way a disk fails, in every command that
# writes, and checks that each end is either whole or exit code 6, and that the same command then gives
# what an undisturbed one gives.
#
#   tests/faults.sh PROGRAM SYNTHETIC FAULTS CONFIG [KIND...]
#
# In the end the process is killed before every such call instead.
# FAULTS is the library of tests/support/fault_injection.cpp. Some thousand runs of hundredths of a second.
set -uo pipefail

program=$1 synthetic=$2 faults=$3 config=$4
shift 4
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(write fsync open rename close)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
total=0

fail() {
  echo "FAILED: $*" >&2
  sed 's/^/  /' "$scratch/err" >&2
  exit 1
}

faulty() {  # KIND ERRNO AT COMMAND...
  local kind=$1 errno=$2 at=$3
  shift 3
  rm -f "$scratch/hit"
  LD_PRELOAD=$faults DRIFT_FAULT_KIND=$kind DRIFT_FAULT_ERRNO=$errno DRIFT_FAULT_AT=$at DRIFT_FAULT_HIT=$scratch/hit \
    timeout 120 "$@" >"$scratch/out" 2>"$scratch/err"
}

# A command that writes one file, which is the same whenever it is written.
each_file() {  # NAME COMMAND...
  local target=$scratch/$1 code at
  shift
  "$@" -o "$target" >/dev/null 2>"$scratch/err" || fail "$* without a fault"
  cp "$target" "$scratch/whole"
  for kind in "${kinds[@]}"; do
    for errno in 28 5 122 13 30; do
      for ((at = 0; ; ++at)); do
        rm -f "$target"
        faulty "$kind" $errno $at "$@" -o "$target"
        code=$?
        [ -e "$scratch/hit" ] || break
        total=$((total + 1))
        case $code in
          0) cmp -s "$target" "$scratch/whole" || fail "$* with $kind $at, errno $errno: exit 0 and another file" ;;
          6) [ -e "$target" ] && ! cmp -s "$target" "$scratch/whole" && fail "$* with $kind $at, errno $errno: a broken file" ;;
          *) fail "$* with $kind $at, errno $errno: exit $code" ;;
        esac
      done
    done
  done
  ls -A "$scratch" | grep -q '^\.driftscope-' && fail "$*: temporary files are left"
  echo "whole or nothing: ${*##*/}"
}

# A command that fills a folder: after any fault the same command completes it. The files of an answer
# are all there, or there is no folder; those of a study come one after the other.
each_folder() {  # CHECK COMMAND...
  local check=$1 folder code at reference
  shift
  folder=$scratch/folder
  rm -rf "$folder"
  "$@" -o "$folder" >/dev/null 2>"$scratch/err" || fail "$* without a fault"
  reference=$($check "$folder")
  for kind in "${kinds[@]}"; do
    for errno in 28 5 30; do
      for ((at = 0; ; ++at)); do
        rm -rf "$folder"
        faulty "$kind" $errno $at "$@" -o "$folder"
        code=$?
        [ -e "$scratch/hit" ] || break
        total=$((total + 1))
        [ $code -eq 0 ] || [ $code -eq 6 ] || fail "$* with $kind $at, errno $errno: exit $code"
        [ $code -ne 0 ] || [ "$($check "$folder")" = "$reference" ] ||
          fail "$* with $kind $at, errno $errno: exit 0 and other results"
        [ "$check" = digest ] || [ ! -e "$folder" ] || [ "$($check "$folder")" = "$reference" ] ||
          fail "$* with $kind $at, errno $errno: a part of an answer"
        "$@" -o "$folder" >/dev/null 2>"$scratch/err" || fail "$* after $kind $at, errno $errno: not resumed"
        [ "$($check "$folder")" = "$reference" ] || fail "$* after $kind $at, errno $errno: other results"
        ls -A "$folder" | grep -q '^\.driftscope-' && fail "$* after $kind $at: temporary files are left"
      done
    done
  done
  echo "completed after every fault: ${*##*/}"
}

# The same where the process is killed before the call: what it left is completed, whatever it is.
each_kill() {  # CHECK COMMAND...
  local check=$1 folder=$scratch/folder at reference
  shift
  rm -rf "$folder"
  "$@" -o "$folder" >/dev/null 2>"$scratch/err" || fail "$* without a kill"
  reference=$($check "$folder")
  for ((at = 0; ; ++at)); do
    rm -rf "$folder"
    DRIFT_FAULT_SIGNAL=9 faulty any 0 $at "$@" -o "$folder"
    [ -e "$scratch/hit" ] || break
    total=$((total + 1))
    "$@" -o "$folder" >/dev/null 2>"$scratch/err" || fail "$* after a kill before call $at: not completed"
    [ "$($check "$folder")" = "$reference" ] || fail "$* after a kill before call $at: other results"
    ls -A "$folder" | grep -q '^\.driftscope-' && fail "$* after a kill before call $at: temporary files are left"
  done
  echo "completed after every kill: ${*##*/}"
}

digest() { "$synthetic" verify "$1" --sample 0% 2>&1 | sed -n 's/^results //p'; }
# When it was made is all in which two calls may differ.
dateless() { cat "$@" | sed 's/^  "date": "[^"]*",$//' | sha256sum; }
numbers() { dateless "$1"/identification.json "$1"/recording.csv "$1"/*.svg; }
answers() { cat "$1"/key.json "$1"/answers.json "$1"/trials/*/recording.csv | sha256sum; }
diagnoses() { sed '/^ "seconds": {/,/^ }/d' "$1"/diagnosis.json | dateless - "$1"/*.svg; }
ranks() { dateless "$1"/rank.json "$1"/*.svg; }

cat >"$scratch/synthetic.toml" <<'EOF'
schema = 1
title  = "synthetic columns=12 points=2 fail_every=50"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
[truth]
coupling = "eq5"
[[filter]]
name     = "eq5"
coupling = "eq5"
[monte_carlo]
runs = 320
allowed_failures = 99
EOF
blind=$scratch/blind.toml
sed -n '/R"toml(/,/^)toml/{s/.*R"toml(//;/^)toml/!p}' "$(dirname "$0")/support/tiny_blind_study.hpp" >"$blind"
"$synthetic" run "$scratch/synthetic.toml" -o "$scratch/study" >/dev/null 2>&1 || fail "the study"

for format in csv h5 mat; do each_file "r.$format" "$program" simulate "$config"; done
for format in csv json hdf5; do each_file "x.$format" "$synthetic" export "$scratch/study" --format "$format"; done
"$program" run "$config" --runs 64 -o "$scratch/named" >/dev/null 2>&1 || fail "the study of arrays with names"
each_file x.nc "$program" export "$scratch/named" --format netcdf
for format in csv h5 mat; do each_file "c.$format" "$program" convert "$config" "$scratch/r.csv"; done
each_file new.toml "$program" new study
each_folder digest "$synthetic" run "$scratch/synthetic.toml" --threads 1
each_folder numbers "$program" identify "$config" --threads 1
each_folder ranks "$program" rank "$config"
each_kill digest "$synthetic" run "$scratch/synthetic.toml" --threads 1
each_kill numbers "$program" identify "$config" --threads 1
each_kill ranks "$program" rank "$config"
each_kill diagnoses "$program" diagnose "$config" "$scratch/r.csv" --threads 1
each_kill answers "$program" blind "$blind" --trials 2 --threads 1
each_kill answers "$program" blind "$blind" --trials 2 --threads 1 --worker 0/1
echo "$total faults, every end whole or exit code 6"
