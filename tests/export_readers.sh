#!/usr/bin/env bash
# Many cheap runs in bounded memory, exported, and opened by h5py, netCDF4, xarray with pandas, Octave
# and sqlite3: all must see the same numbers.
#
#   tests/export_readers.sh driftscope_synthetic [RUNS]
set -euo pipefail

program=$(realpath "$1") runs=${2:-100000}
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
sed -e 's/^title.*/title = "synthetic columns=20 fail_every=1000 points=2"/' -e "s/^runs.*/runs = $((runs / 2))/" \
  "$source/support/synthetic.toml" >study.toml

peak_kb() { /usr/bin/python3 -c 'import resource, subprocess, sys
code = subprocess.call(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
sys.exit(code)' "$@"; }

run_kb=$(peak_kb "$program" run study.toml -o out --progress none)
export_kb=$(peak_kb "$program" export out --format hdf5 -o x.h5)
"$program" export out --format csv -o x.csv >/dev/null
data_kb=$((runs * 20 * 8 / 1024))
echo "$runs runs, $data_kb kB of numbers: peak memory $run_kb kB running, $export_kb kB exporting"
[ "$run_kb" -lt 100000 ] && [ "$export_kb" -lt 150000 ]

/usr/bin/python3 - "$runs" <<'PY'
import sys
import h5py, netCDF4, numpy as np, pandas as pd, xarray as xr
n = int(sys.argv[1])
f = h5py.File("x.h5", "r")
a = f["runs/made_3"][:]
assert a.shape == (n,) and f["runs/made_3"].attrs["units"] == b"arcsec", a.shape
assert f.attrs["seed"] == b"7" and b"points=2" in f.attrs["study"]
frame = xr.open_dataset("x.h5", group="runs").to_dataframe()
assert np.array_equal(frame["made_3"].to_numpy(), a, equal_nan=True)
bad = frame["status"] != 0
assert bad.sum() == n // 1000 and frame.loc[bad, "made_3"].isna().all() and frame.loc[~bad].notna().all().all()
assert f["runs/status"].attrs["flag_meanings"].split()[2] == b"filter_diverged"
nc = netCDF4.Dataset("x.h5")["runs"]["made_3"][:]
assert np.array_equal(np.ma.filled(nc, np.nan), a, equal_nan=True)
csv = pd.read_csv("x.csv", comment="#", float_precision="round_trip")
assert np.array_equal(csv["made/3 [arcsec]"].to_numpy(), a, equal_nan=True), "CSV and HDF5 differ"
summary = xr.open_dataset("x.h5", group="summary")
good = frame[~bad & (frame["point"] == 1)]["made_3"]
assert summary["n"][1, 3] == len(good)
assert abs(summary["mean"][1, 3] - good.mean()) < 1e-9 * good.std() and abs(summary["sd"][1, 3] / good.std() - 1) < 1e-9
np.savetxt("sum.txt", [np.nansum(a)], fmt="%.17g")
print("h5py, netCDF4, xarray, pandas: same numbers")
PY

octave-cli --quiet --eval 'x = load("x.h5"); s = load("sum.txt"); v = x.runs.made_3(:); t = sum(v(! isnan(v)));
  assert(numel(v), '"$runs"'); assert(abs(t - s) < 1e-9 * sum(abs(v(! isnan(v))))); disp("Octave: same numbers");' 2>octave.log \
  | grep "Octave: same numbers" || { cat octave.log; exit 1; }
sqlite3 out/worker-0000.sqlite 'SELECT sum(runs) FROM blocks' | grep -qx "$runs"
echo "sqlite3: all runs"
