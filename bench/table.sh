#!/usr/bin/env bash
# Measures driftscope against its peers and writes bench_table.json and bench_table.md into the folder
# it is called from: bench/table.sh [--against OLD.json] [KEY...]; without keys all of them.
# Builds the preset `perf` first (this CPU, optimised). CPU time on both sides, both in one process.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cmake -S "$here" -B "$here/build/perf" --preset perf > "$here/build/perf.log" 2>&1 ||
    { cat "$here/build/perf.log" >&2; exit 1; }
cmake --build "$here/build/perf" --target bench_ekf bench_study bench_sensitivities bench_servo bench_kernels driftscope >&2
exec python3 "$here/bench/table.py" --bin "$here/build/perf/bin" "$@"
