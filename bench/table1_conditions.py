#!/usr/bin/env python3
"""Under which conditions does a filter on the wrong equation behave as in Table 1 of the paper?

Runs `driftscope identify` on every combination of plan, readout, terms left out of the filter, priors
and truth, and lists those in which the eq. (6) filter gives all three parameters depending on the start
(ratio above 5) while the eq. (5) filter gives none. About two minutes on two cores.

Usage: bench/table1_conditions.py PROGRAM      (build/release/bin/driftscope)
"""
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE1 = (ROOT / "configs/table1.toml").read_text()
PUBLISHED = TABLE1[TABLE1.index("[[published]]"):]
TURNED = re.search(r"\[plan\].*?(?=\[readout\])", TABLE1, re.S).group(0)
KEYS = ("D_I_z", "D_S_x", "eta_x")


def six(dwell, sample, entry):
    return f'[plan]\npreset = "six"\ndwell = "{dwell}"\nsample = "{sample}"\nmode = "free"\nentry = "{entry}"\n'


PLANS = {
    "six caged, 60 min": six("60 min", "60 s", "caged"),
    "six caged, 5 min": six("5 min", "20 s", "caged"),
    "six slewed, 5 min": six("5 min", "20 s", "torqued"),
    "case turned, 4 min": TURNED,
    "case turned, 1 min": TURNED.replace("4 min", "1 min").replace("20 s", "10 s"),
}
READOUTS = {
    "accelerometers 5 ug": ("5 ug", None),
    "both, 250 ug, 45 arcsec": ("250 ug", "45 arcsec"),
}
FILTERS = {"15 states": ["D_F", "D_I", "D_S", "eta"], "21 states": ["fixed_drift", "g_drift", "gyro_misalignment"]}
TRUTHS = {
    "nothing left out": None,
    "D_O, g^2, xi left out": ["fixed_drift", "g_drift", "g2_drift", "gyro_misalignment"],
    "torquers and accelerometers too": ["fixed_drift", "g_drift", "g2_drift", "gyro_misalignment", "torquer_scale", "accelerometer"],
}
PRIORS = {
    "default priors": "",
    "wide priors": 'D_F = { normal = ["0 deg/h", "10 deg/h"] }\nD_I = { normal = ["0 deg/h/g", "10 deg/h/g"] }\n'
                   'D_S = { normal = ["0 deg/h/g", "10 deg/h/g"] }\neta = { normal = ["0 arcsec", "2000 arcsec"] }\n',
}


def study(plan, readout, filter_terms, truth_terms, prior, coupling):
    acc, gimbal = readout
    text = f'schema = 1\n[site]\nlatitude = "45.75 deg"\n{plan}'
    text += f'[readout]\naccelerometer_noise = "{acc}"\ngimbals = {"true" if gimbal else "false"}\n'
    text += f'gimbal_noise = "{gimbal or "5 arcsec"}"\n[truth]\ncoupling = "{coupling}"\n'
    text += f"terms = {json.dumps(truth_terms or filter_terms)}\n[truth.parameters]\n"
    text += 'D_I_z = "1.45 deg/h/g"\nD_S_x = "0.33 deg/h/g"\neta_x = "112 arcsec"\n'
    for name in ("eq5", "eq6"):
        text += f'[[filter]]\nname = "{name}"\ncoupling = "{name}"\nterms = {json.dumps(filter_terms)}\nstarts = 3\n'
        text += f"[filter.parameters]\n{prior}" if prior else ""
    return text + "[monte_carlo]\nseed = 1\n" + PUBLISHED


def main(program):
    found, count, flipped = [], 0, 0
    axes = itertools.product(PLANS, READOUTS, FILTERS, TRUTHS, PRIORS, ("eq5", "eq6"))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "study.toml")
        for plan, readout, terms, truth, prior, coupling in axes:
            path.write_text(study(PLANS[plan], READOUTS[readout], FILTERS[terms], TRUTHS[truth], PRIORS[prior], coupling))
            subprocess.run([program, "identify", path, "-o", folder, "--progress", "none"],
                           check=True, stdout=subprocess.DEVNULL)
            filters = json.loads(pathlib.Path(folder, "identification.json").read_text())["filters"]
            ratio = {f["name"]: [f["parameters"][k]["start_consistency"]["ekf"] or 0.0 for k in KEYS] for f in filters}
            starts = [s["ekf"] for s in filters[1]["starts"]]
            d_i = [s["parameters"]["D_I_z"]["estimate"] for s in starts]
            count += 1
            flipped += all(-2.0 < (d or 0.0) < -1.0 for d in d_i)
            if min(ratio["eq6"]) > 5 > max(ratio["eq5"]):
                found.append((plan, readout, terms, truth, prior, coupling, ratio, min(s["chi2_per_dof"] or 0.0 for s in starts)))
    print(f"{count} conditions; in {len(found)} only the eq. (6) filter depends on the start in all of {', '.join(KEYS)};")
    print(f"smallest NIS/m of it there: {min((f[-1] for f in found), default=float('nan')):.1f}; ", end="")
    print(f"all three D_I_z between -2 and -1 deg/h/g: {flipped} conditions")
    for *what, ratio, nis in found:
        shown = "  ".join(name + " " + " ".join(f"{r:.2g}" for r in rs) for name, rs in ratio.items())
        print(f"truth {what[-1]}: {', '.join(what[:-1])}: {shown}; NIS/m {nis:.3g}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
