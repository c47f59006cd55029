#!/usr/bin/env bash
# What a program has against being misused: position-independent, tables of functions read-only from the
# start, no executable stack; in a Release build besides checks of the stack and of the sizes of buffers, and
# nothing in it of where it was built.
#
#   tests/checks/hardened.sh PROGRAM [BUILD TYPE, Release unless given]
set -uo pipefail
program=$1 type=${2:-Release}
has() {  # WHAT, PATTERN, TEXT
  grep -q -- "$2" <<<"$3" || { echo "FAILED: $program: $1 is missing"; exit 1; }
}
segments=$(readelf -lW "$program") dynamic=$(readelf -dW "$program") symbols=$(readelf --dyn-syms -W "$program")
has "a read-only table of functions" GNU_RELRO "$segments"
has "binding at the start, position independence" 'NOW.* PIE' "$dynamic"
has "a stack that is not executable" 'GNU_STACK.* RW ' "$segments"
[ "$type" = Release ] || exit 0
has "the check of the stack (-fstack-protector-strong)" __stack_chk_fail "$symbols"
has "the check of buffers (_FORTIFY_SOURCE)" '_chk@GLIBC' "$(grep -v __stack_chk_fail <<<"$symbols")"
root=$(cd "$(dirname "$0")/../.." && pwd)
if grep -aqF "$root/" "$program"; then echo "FAILED: $program: holds the path $root"; exit 1; fi
