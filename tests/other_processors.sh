#!/usr/bin/env bash
# The program on processors that lack what it was compiled for: it says so and exits with 2, where it would
# end by SIGILL otherwise; on one that has them its results are those of this machine, bit for bit. The
# processors are those of QEMU's user mode.
#
#   tests/other_processors.sh PROGRAM STUDY
#
# 77 where there is no qemu-x86_64 or the program needs no extension of x86-64.
set -uo pipefail
program=$(realpath "$1") study=$(realpath "$2")
command -v qemu-x86_64 >/dev/null || { echo "skipped: no qemu-x86_64 (Debian: qemu-user)"; exit 77; }
"$program" version | grep -q '^instruction_set  x86-64 with' || { echo "skipped: built for any x86-64"; exit 77; }
fail() {
  echo "FAILED: $*" >&2
  exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for cpu in qemu64 Nehalem; do  # 2003, 2008: without AVX
  qemu-x86_64 -cpu $cpu "$program" version >"$scratch/out" 2>"$scratch/err"
  code=$?
  [ $code -eq 2 ] || fail "exit $code on $cpu: $(cat "$scratch/err")"
  [ ! -s "$scratch/out" ] || fail "output on $cpu: $(cat "$scratch/out")"
  grep -q 'this processor lacks instructions.* avx2 .*(expected .*portable' "$scratch/err" || fail "on $cpu: $(cat "$scratch/err")"
done
echo "refused in words on qemu64 and Nehalem: $(cat "$scratch/err")"

results() { sed -n 's/^results \([0-9a-f]*\)$/\1/p'; }  # of what `run` prints
cd "$scratch" || exit 1
run=("$program" run "$study" --runs 128 --threads 1 --progress none)
here=$("${run[@]}" -o here 2>/dev/null | results)
[ -n "$here" ] || fail "no results on this machine"
there=$(qemu-x86_64 -cpu Haswell "${run[@]}" -o there 2>err | results)
if grep -q 'this processor lacks instructions' err; then
  echo "the results of another processor: not compared, the program is for this one alone"
else
  [ "$there" = "$here" ] || fail "the results on Haswell are '$there', expected '$here': $(cat err)"
  echo "the results on Haswell are those of this machine"
fi
