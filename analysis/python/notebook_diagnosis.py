# %% [markdown]
# # A diagnosis, from a recording to the missing effect
# Run it cell by cell in an editor that knows `# %%`, or whole: python3 notebook_diagnosis.py [FOLDER].
# The program is `driftscope` on the path, or what the variable DRIFTSCOPE names.

# %%
import os
import subprocess
import sys
from pathlib import Path

import driftscope

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/notebook_diagnosis")
folder.mkdir(parents=True, exist_ok=True)
program = os.environ.get("DRIFTSCOPE", "driftscope")


def run(*words):
    subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


# %% [markdown]
# ## A recording with an effect in it that the model does not have
# The y gyro feels the Earth's field, 0.02 deg/h a gauss; the model in [[filter]] knows nothing of that.

# %%
study = folder / "study.toml"
study.write_text("""schema = 1
title = "A magnetic y gyro"
[site]
latitude = "45.75 deg"
[plan]
preset = "twentyfour"
dwell  = "20 min"
sample = "5 min"
[environment]
field_n = "0.25 gauss"
field_w = "0 gauss"
field_u = "-0.47 gauss"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "g2_drift", "gyro_misalignment", "torquer_scale", "accelerometer", "magnetic_drift.y"]
[truth.parameters]
M_y = "0.02 deg/h/gauss"
[[filter]]
name = "nominal"
coupling = "eq5"
[monte_carlo]
seed = 3
""", encoding="utf-8")
run("simulate", study, "-o", folder / "rec.csv")
rec = driftscope.recording(folder / "rec.csv")
print(f"{len(rec)} rows, {rec.position.nunique()} positions, acc_x in {rec.attrs['units']['acc_x']}")

# %% [markdown]
# ## What is missing

# %%
run("diagnose", study, folder / "rec.csv", "-o", folder / "diagnosis", "--progress", "none")
found = driftscope.diagnosis(folder / "diagnosis")
print("verdict:", found.verdict)
print(found.causes[["term", "axis", "key", "value", "sigma", "unit", "probability"]].to_string(index=False))

# %% [markdown]
# ## Against its rivals, and what it did to the parameters

# %%
print(found.candidates[["label", "score", "p_value", "absorbed"]].head(5).to_string(index=False))
print(found.shifted.head(5).to_string(index=False))
held_out = found["fit"]["held_out"]
print(f"held out: chi2/dof {held_out['chi2_per_dof_before']:.2f} -> {held_out['chi2_per_dof_after']:.2f}")

# %% [markdown]
# ## The recovered signal against time

# %%
signal = found.signal
print(signal.groupby("equation")["value"].agg(["min", "max"]).to_string())
try:
    import matplotlib
except ImportError:
    print("no picture: matplotlib is not installed")
else:
    matplotlib.use("agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots()
    for equation, part in signal.groupby("equation"):
        axes.plot(part["time [s]"] / 3600.0, part["value"], label=f"{equation} [{part['unit'].iloc[0]}]")
    axes.set_xlabel("time [h]")
    axes.legend()
    figure.savefig(folder / "signal.png")
