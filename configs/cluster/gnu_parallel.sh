#!/usr/bin/env bash
# One study over machines that share a file system, by GNU parallel: MACHINES has a host name a line.
#
#   configs/cluster/gnu_parallel.sh STUDY.toml RESULTS 16 [MACHINES]
#
# Absolute paths, since every machine starts in its own folder. Ctrl-C stops it; the same command goes on.
study=$(realpath "$1") results=$(realpath -m "$2") parts=$3
mkdir -p "$results"
parallel --quote ${4:+--sshloginfile "$4"} --jobs 1 --halt soon,fail=1 \
  "${DRIFTSCOPE:-driftscope}" run "$study" -o "$results" --worker "{}/$parts" --progress none ::: $(seq 0 $((parts - 1))) &&
  "${DRIFTSCOPE:-driftscope}" run "$study" -o "$results"
