#!/usr/bin/env bash
# A rank of mpirun that stops alone stops the others: at a failed run, and asked by a signal. What another
# rank than the first mends of its file is told.
#
#   tests/ranks_stop.sh SYNTHETIC
#
# 4,000 runs of 10 ms are 20 s of two ranks; who stops at the third run leaves most of them undone.
set -uo pipefail

synthetic=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mpi=(mpirun --allow-run-as-root --oversubscribe --bind-to none -n 2)

expect_early_end() {  # NAME WHAT THE RUN DOES, EXIT CODE, OPTIONS...
  local folder=$scratch/$1 code stored
  sed "s/^title .*/title = \"synthetic columns=5 ms=10 together=8 $2\"/; s/^runs .*/runs = 4000/" \
    "$(dirname "$0")/support/synthetic.toml" >"$scratch/$1.toml"
  "${mpi[@]}" "$synthetic" run "$scratch/$1.toml" --threads 1 --progress none -o "$folder" "${@:4}" \
    >"$scratch/$1.log" 2>&1
  code=$?
  stored=$("$synthetic" status "$folder" | sed -n '1s/.*: \([0-9]*\) of .*/\1/p')
  if [ "$code" != "$3" ] || [ "${stored:-4000}" -gt 400 ]; then
    cat "$scratch/$1.log" >&2
    echo "FAILED: $1 ends with $code (expected $3), ${stored:-no} of 4000 runs stored (expected at most 400)" >&2
    exit 1
  fi
  echo "$1: exit $code, $stored of 4000 runs stored"
}

expect_early_end fail_fast throw_at=3 5 --fail-fast
expect_early_end signal stop_at=3 143

folder=$scratch/notes
study() { "${mpi[@]}" "$synthetic" run "$(dirname "$0")/support/synthetic.toml" --threads 1 --progress none -o "$folder" 2>&1; }
study >"$scratch/notes.log"
damaged=0
for file in "$folder"/worker-*.sqlite; do
  python3 -c 'import sqlite3, sys
db = sqlite3.connect(sys.argv[1])
db.execute("UPDATE blocks SET payload = CAST(substr(payload, 1, 99) || X'"'5a5a'"' || substr(payload, 102) AS BLOB) WHERE id = 1")
db.commit()' "$file"
  damaged=$((damaged + 1))
done
said=$(study | grep -c 'damaged blocks removed')
if [ "$said" != "$damaged" ] || [ "$damaged" != 2 ]; then
  echo "FAILED: $damaged files were damaged, $said notes say so" >&2
  exit 1
fi
echo "notes: of both ranks"
