# %% [markdown]
# # A sweep: how often is a filter wrong, and does it know?
# Run it cell by cell in an editor that knows `# %%`, or whole: python3 notebook_sweep.py [FOLDER].
# The program is `driftscope` on the path, or what the variable DRIFTSCOPE names.

# %%
import os
import subprocess
import sys
from pathlib import Path

import driftscope

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/notebook_sweep")
folder.mkdir(parents=True, exist_ok=True)
program = os.environ.get("DRIFTSCOPE", "driftscope")


def run(*words):
    subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


# %% [markdown]
# ## One study point for every misalignment; the truth is eq. (5), one filter believes eq. (6)

# %%
study = folder / "study.toml"
study.write_text("""schema = 1
title = "A misaligned x gyro"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "30 min"
sample = "3 min"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
[truth.parameters]
eta = "0 arcsec"
xi = "0 arcsec"
[[filter]]
name = "eq5"
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
starts = 2
[[filter]]
name = "eq6"
coupling = "eq6"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
[monte_carlo]
runs = 60
seed = 1
[sweep]
"truth.parameters.eta_x" = ["0 arcsec", "25 arcsec", "50 arcsec", "100 arcsec"]
""", encoding="utf-8")
run("run", study, "-o", folder / "results", "--progress", "none")
run("export", folder / "results", "--format", "netcdf")

# %% [markdown]
# ## Every number by its name

# %%
ds = driftscope.open(folder / "results")
print(dict(ds.sizes))
swept = ds.truth_parameters_eta_x
error = ds.estimate - ds.truth
z = (error / ds.sigma).sel(start=1)
print(f"errors of eta_x, eq. (6), over sigma: {float(z.sel(filter='eq6', parameter='eta_x').std()):.2f} (1 if honest)")

# %% [markdown]
# ## The rate against what was swept

# %%
wrong = (abs(z) > 5.0).any("parameter").mean("run")
for f in ("eq5", "eq6"):
    for eta, rate in zip(swept.values, wrong.sel(filter=f).values):
        print(f"{f}: eta_x = {eta:5.0f} {swept.attrs['units']}: {rate:6.1%} of the runs are wrong by 5 sigma")

# %% [markdown]
# ## The same from the program's own statistics, and what a start changes

# %%
statistics = driftscope.open(folder / "results", "statistics")
silent = statistics.silent_failure_rate.sel(parameter="eta_x", filter="eq6")
print("silent failures of eta_x:", [f"{r:.1%}" for r in silent.values])
apart = abs(ds.estimate.sel(start=2) - ds.estimate.sel(start=1)).sel(filter="eq5", parameter="eta_x")
print(f"eq5, start 2 against start 1: eta_x at most {float(apart.max()):.3g} arcsec apart")
try:
    import matplotlib
except ImportError:
    print("no picture: matplotlib is not installed")
else:
    matplotlib.use("agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots()
    for f in ("eq5", "eq6"):
        axes.plot(swept, wrong.sel(filter=f), "o-", label=f)
    axes.set_xlabel(f"true eta_x [{swept.attrs['units']}]")
    axes.set_ylabel("share of runs wrong by 5 sigma")
    axes.legend()
    figure.savefig(folder / "rates.png")
