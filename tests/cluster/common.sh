# What the scripts beside this one begin with; sourced with their first arguments, PROGRAM CONFIG: both as
# full paths, the job scripts in $jobs, a folder in $scratch that goes at the end, and a few words.
program=$(realpath "$1") config=$(realpath "$2")
jobs=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../configs/cluster" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# What is equal for the results of a study however they came about.
digest() { "$program" verify "$1" --sample 0% | sed -n 's/^results //p'; }

# What they are to be: those of one process, in $reference.
run_reference() {
  "$program" run "$config" -o "$scratch/reference" --progress none >/dev/null 2>&1
  reference=$(digest "$scratch/reference")
  [ -n "$reference" ] || fail "no digest of one process"
}
