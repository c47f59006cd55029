"""Recordings made without driftscope, from its published conventions alone, and diagnosed by it.

The platform is integrated here a second time (rotation matrices, Runge-Kutta of order 4, numpy), with
equations and signs taken from the README of core and from `driftscope terms`. A sign or frame that
simulator and diagnosis share wrongly would go unseen in every other test.

    tests/independent_recording.py PROGRAM [CASE...]

Each case hides one effect of about ten sigma and more; half of them have rows at unequal distances (HABITS), one a
covariate in a unit that nobody knows, one a field that is known by default alone. Exit code 1 if a cause is not named, if its size is off by
more than 4 sigma, or if nothing is hidden and a base parameter is off by more than 4.5.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ARCSEC = math.pi / 180 / 3600  # also deg/h in rad/s
UG = 1e-6
LATITUDE = math.radians(45.75)
W_IE_L = 15.041067 * ARCSEC * np.array([math.cos(LATITUDE), 0.0, math.sin(LATITUDE)])
FIELD_L = np.array([0.25, 0.02, -0.47])  # gauss
DWELL, SAMPLE, STEP = 3600.0, 60.0, 20.0
ACC_NOISE, GIMBAL_NOISE = 5 * UG, 5 * ARCSEC
HABITS = ["equal", "mixed", "equal", "jittered", "equal", "lost"]  # of loggers, case after case
DIRECTIONS = {"N": (1, 0, 0), "S": (-1, 0, 0), "W": (0, 1, 0), "E": (0, -1, 0), "U": (0, 0, 1), "D": (0, 0, -1)}
PAIRS = ["NU", "WU", "ND", "ED", "WN", "UW", "SW", "US", "EN", "DW", "NE", "DN", "UE", "WD", "DS", "ES"]  # x_p and z_p


def position(x, z):
    """Axes of the platform, and a heading of the case that keeps the middle gimbal near 0."""
    y = tuple(np.cross(DIRECTIONS[z], DIRECTIONS[x]))
    return x, next(d for d, v in DIRECTIONS.items() if v == y), z, 90 if z in "NS" else 0


POSITIONS = [position(*pair) for pair in PAIRS]
LAWS = ["free", "level"]
TRIADS = [(0, 1, 2), (1, 2, 0), (2, 0, 1)]  # input, output, spin axis of each gyro


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(v):
    angle = np.linalg.norm(v)
    if angle == 0:
        return np.eye(3)
    k = skew(v / angle)
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def draw_truth(rng):
    """Base parameters, file units, as in the default priors; g^2 terms traceless small."""
    sizes = dict(D_F=1.0, D_I=2.0, D_O=0.3, D_S=2.0, D_II=0.1, D_OO=0.1, D_SS=0.1, D_IO=0.1, D_IS=0.1, D_OS=0.1,
                 eta=200.0, xi=200.0, s=1000.0, K0=500.0, K1=500.0, K2=50.0, K3=20.0, K_ip=50.0, dP=100.0, dO=100.0)
    return {f"{k}_{a}": rng.normal(0, s) for k, s in sizes.items() for a in "xyz"}


def gyro_rate(p, f, t, effect, seen):
    """w_l of each gyro [rad/s]: IEEE form, a in platform axes."""
    w = np.zeros(3)
    for i, axis in enumerate("xyz"):
        a, o, s = (f[k] for k in TRIADS[i])
        g = lambda key: p[f"{key}_{axis}"]
        w[i] = (g("D_F") + g("D_I") * a + g("D_O") * o + g("D_S") * s + g("D_II") * a * a + g("D_OO") * o * o +
                g("D_SS") * s * s + g("D_IO") * a * o + g("D_IS") * a * s + g("D_OS") * o * s)
    hours = t / 3600
    kind, axis, size = effect.get("kind"), effect.get("axis", 0), effect.get("size", 0.0)
    a = f[TRIADS[axis][0]]
    if kind == "drift_ramp":
        w[axis] += size * hours
    elif kind == "warmup_drift":
        w[axis] += size * math.exp(-t / 2400)
    elif kind == "mass_unbalance_step":
        w[axis] += size * a * (t >= 5 * 3600)
    elif kind == "magnetic_drift":
        w[axis] += size * seen["field_p"][axis]
    elif kind == "temperature_drift":
        w[axis] += size * seen["dT"]
    elif kind == "temperature_g_drift":
        w[axis] += size * a * seen["dT"]
    elif kind == "gimbal_angle_drift":
        w[axis] += size * math.cos(seen["gimbals"][2])
    elif kind == "reposition_transient":
        w[axis] += size * (a - seen["settled"])
    return w * ARCSEC


def gimbal_angles(R_cp):
    """Of v_c = Rx(outer) Ry(middle) Rz(inner) v_p."""
    return np.array([math.atan2(-R_cp[1, 2], R_cp[2, 2]), math.asin(R_cp[0, 2]), math.atan2(-R_cp[0, 1], R_cp[0, 0])])


def row_lengths(habit, rng):
    """Of a dwell [s]."""
    if habit == "mixed":
        return [SAMPLE / 3] * 60 + [SAMPLE] * 40
    ends = SAMPLE * np.arange(round(DWELL / SAMPLE) + 1)
    if habit == "jittered":
        ends[2:-1] += rng.uniform(-0.05 * SAMPLE, 0.05 * SAMPLE, len(ends) - 3)
    return np.diff(ends)


def simulate(p, coupling, effect, rng, laws, habit):
    """Rows of a recording: time, position, phase, acc (3), gimbals (3), cmd (3), temperature."""
    of_rows = np.random.default_rng(len(habit))
    kind, axis_of_effect, size = effect.get("kind"), effect.get("axis", 0), effect.get("size", 0.0)
    W_IE = W_IE_L  # what the Earth does; the commands follow W_IE_L
    if kind == "latitude_error":
        W_IE = 15.041067 * ARCSEC * np.array([math.cos(LATITUDE + size * ARCSEC), 0.0, math.sin(LATITUDE + size * ARCSEC)])
    elif kind == "azimuth_error":
        W_IE = rotation([0, 0, -size * ARCSEC]) @ W_IE_L
    E = np.zeros((3, 3))
    for i, axis in enumerate("xyz"):
        E[i, TRIADS[i][2]] = p[f"eta_{axis}"] * ARCSEC
        E[i, TRIADS[i][1]] = p[f"xi_{axis}"] * ARCSEC
    C, s_T = np.eye(3) + E, np.array([p[f"s_{a}"] for a in "xyz"]) * 1e-6
    temperature = lambda t: 0.4 * math.sin(2 * math.pi * t / 86400) + 0.15 * math.sin(2 * math.pi * t / 17000)

    settled = None  # of reposition_transient: a_I as the fluid knows it
    rows, t = [], 0.0
    for number, (x, y, z, heading) in enumerate(POSITIONS):
        R0 = np.array([DIRECTIONS[x], DIRECTIONS[y], DIRECTIONS[z]], float).T
        R = rotation(rng.normal(0, 200 * ARCSEC, 3)) @ R0
        h = math.radians(heading)
        R_lc = np.array([[math.cos(h), -math.sin(h), 0], [math.sin(h), math.cos(h), 0], [0, 0, 1]])
        w_cmd = R0.T @ W_IE_L if laws[number % len(laws)] == "level" else np.zeros(3)

        def rate(R, t):
            """w_lp; the case is fixed to the local axes but for a tilting pier, which turns it slowly."""
            f, w_ic = R.T @ [0, 0, 1], R.T @ W_IE
            seen = {"field_p": R.T @ FIELD_L, "dT": temperature(t), "gimbals": gimbal_angles(R_lc.T @ R), "settled": settled}
            u = gyro_rate(p, f, t, effect, seen) - (1 + s_T) * w_cmd
            if kind == "torquer_asymmetry":
                u[axis_of_effect] -= size * 1e-6 * abs(w_cmd[axis_of_effect])
            M = C.copy()
            if kind == "misalignment_creep":
                M[axis_of_effect, TRIADS[axis_of_effect][2]] += size * ARCSEC * t / 3600
            return -M @ w_ic - u if coupling == "eq5" else -w_ic - np.linalg.solve(M, u)

        def accelerometers(R, t):
            f = R.T @ [0, 0, 1]
            out = np.zeros(3)
            for i, axis in enumerate("xyz"):
                a, o1, o2 = (f[k] for k in TRIADS[i])
                g = lambda key: p[f"{key}_{axis}"]
                out[i] = (g("K0") * UG + (1 + g("K1") * 1e-6) * (a + g("dP") * ARCSEC * o1 + g("dO") * ARCSEC * o2) +
                          g("K2") * UG * a ** 2 + g("K3") * UG * a ** 3 + g("K_ip") * UG * a * o1)
            a = f[TRIADS[axis_of_effect][0]]
            if kind == "accelerometer_ramp":
                out[axis_of_effect] += size * UG * t / 3600
            elif kind == "accelerometer_temperature":
                out[axis_of_effect] += size * 1e-6 * a * temperature(t)
            elif kind == "accelerometer_dead_zone":
                out[axis_of_effect] -= size * UG * math.tanh(a / 500e-6)
            return out

        if settled is None:
            settled = R[2, TRIADS[axis_of_effect][0]]
        lengths = row_lengths(habit, of_rows)
        for row, length in enumerate(lengths):
            steps = round(length / STEP / 2) * 2 or 2
            dt = length / steps
            nodes = [accelerometers(R, t)]
            for k in range(steps):
                def slope(M, tau):
                    return M @ skew(rate(M, tau))
                k1 = slope(R, t)
                k2 = slope(R + dt / 2 * k1, t + dt / 2)
                k3 = slope(R + dt / 2 * k2, t + dt / 2)
                k4 = slope(R + dt * k3, t + dt)
                R = R + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
                u, _, vt = np.linalg.svd(R)
                R = u @ vt
                if kind == "reposition_transient":
                    a = (R.T @ [0, 0, 1])[TRIADS[axis_of_effect][0]]
                    settled += (a - settled) * (1 - math.exp(-dt / 600))
                t += dt
                nodes.append(accelerometers(R, t))
            weights = np.array([1] + [4 if k % 2 else 2 for k in range(1, steps)] + [1]) / (3 * steps)
            acc = weights @ np.array(nodes) + rng.normal(0, ACC_NOISE * math.sqrt(SAMPLE / length), 3)
            R_cp = R_lc.T @ R
            if kind == "pier_tilt":
                R_cp = R_lc.T @ rotation([-size * ARCSEC * math.sin(2 * math.pi * t / 86400), 0, 0]) @ R
            gimbals = gimbal_angles(R_cp)
            if kind == "encoder_harmonics":
                gimbals[axis_of_effect] += size * ARCSEC * math.cos(gimbals[axis_of_effect])
            elif kind == "timing_skew":  # seen `size` milliseconds late
                gimbals += size * 1e-3 * (gimbal_angles(R_lc.T @ R @ rotation(rate(R, t))) - gimbals)
            gimbals += rng.normal(0, GIMBAL_NOISE, 3)
            if habit == "lost" and 0 < row < len(lengths) - 1 and of_rows.random() < 0.1:
                continue
            rows.append([t, number + 1, 0, *acc, *np.degrees(gimbals), *(w_cmd / ARCSEC), 20 + temperature(t)])
    return rows


def study_text(coupling, laws, field):
    text = f"""schema = 1
title = "made without driftscope"
[site]
latitude = "45.75 deg"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[environment]
temperature = "20 degC"
{field}[[filter]]
name = "nominal"
coupling = "{coupling}"
"""
    for number, (x, y, z, heading) in enumerate(POSITIONS):
        text += f"""[[plan.position]]
name = "{number + 1}"
axes = "x={x} y={y} z={z}"
dwell = "60 min"
sample = "60 s"
mode = "{laws[number % len(laws)]}"
entry = "caged"
case_heading = "{heading} deg"
"""
    return text


CASES = {
    "none": ("eq5", {}, "eq5", None),
    "none_eq6": ("eq6", {}, "eq6", None),
    "equation": ("eq5", {}, "eq6", ("frame_closure", "", "lambda", 0.0)),
    "drift_ramp": ("eq5", {"kind": "drift_ramp", "axis": 0, "size": 0.004}, "eq5", ("drift_ramp", "x", "ramp_x", 0.004)),
    "warmup_drift": ("eq6", {"kind": "warmup_drift", "axis": 2, "size": 0.06}, "eq6", ("warmup_drift", "z", "W_z", 0.06)),
    "mass_unbalance_step": ("eq6", {"kind": "mass_unbalance_step", "axis": 1, "size": 0.03}, "eq6",
                            ("mass_unbalance_step", "y", "dD_I_y", 0.03)),
    "magnetic_drift": ("eq5", {"kind": "magnetic_drift", "axis": 1, "size": 0.02}, "eq5", ("magnetic_drift", "y", "M_y", 0.02)),
    "temperature_drift": ("eq6", {"kind": "temperature_drift", "axis": 0, "size": 0.03}, "eq6",
                          ("temperature_drift", "x", "kT_x", 0.03)),
    "temperature_g_drift": ("eq5", {"kind": "temperature_g_drift", "axis": 1, "size": 0.03}, "eq5",
                            ("temperature_g_drift", "y", "kT_I_y", 0.03)),
    "gimbal_angle_drift": ("eq6", {"kind": "gimbal_angle_drift", "axis": 0, "size": 0.01}, "eq6",
                           ("gimbal_angle_drift", "x", "G_c_x", 0.01)),
    "reposition_transient": ("eq5", {"kind": "reposition_transient", "axis": 2, "size": 0.05}, "eq5",
                             ("reposition_transient", "z", "R_z", 0.05)),
    "latitude_error": ("eq6", {"kind": "latitude_error", "size": 40.0}, "eq6", ("latitude_error", "", "d_lat", 40.0)),
    "azimuth_error": ("eq6", {"kind": "azimuth_error", "size": 60.0}, "eq6", ("azimuth_error", "", "d_az", 60.0)),
    "torquer_asymmetry": ("eq5", {"kind": "torquer_asymmetry", "axis": 1, "size": 200.0}, "eq5",
                          ("torquer_asymmetry", "y", "s_a_y", 200.0)),
    "misalignment_creep": ("eq5", {"kind": "misalignment_creep", "axis": 0, "size": 9.0}, "eq5",
                           ("misalignment_creep", "x", "eta_t_x", 9.0)),
    "pier_tilt": ("eq6", {"kind": "pier_tilt", "size": 8.0}, "eq6", ("pier_tilt", "", "tilt_s_n", 8.0)),
    "timing_skew": ("eq6", {"kind": "timing_skew", "size": 100.0}, "eq6", ("timing_skew", "", "skew", 100.0)),
    "accelerometer_temperature": ("eq5", {"kind": "accelerometer_temperature", "axis": 0, "size": 50.0}, "eq5",
                                  ("accelerometer_temperature", "x", "K1_T_x", 50.0)),
    "accelerometer_dead_zone": ("eq6", {"kind": "accelerometer_dead_zone", "axis": 2, "size": 15.0}, "eq6",
                                ("accelerometer_dead_zone", "z", "Z_z", 15.0)),
    "accelerometer_ramp": ("eq5", {"kind": "accelerometer_ramp", "axis": 2, "size": 1.0}, "eq5",
                           ("accelerometer_ramp", "z", "K0_ramp_z", 1.0)),
    "encoder_harmonics": ("eq6", {"kind": "encoder_harmonics", "axis": 0, "size": 5.0}, "eq6",
                          ("encoder_harmonics", "outer", "enc_c1_outer", 5.0)),
}


def run_case(program, name, folder, seed=1):
    truth, effect, nominal, cause = CASES[name]
    habit, dipole, unknown = HABITS[list(CASES).index(name) % len(HABITS)], name == "magnetic_drift", name == "none_eq6"
    field = "" if dipole else 'field_n = "0.25 gauss"\nfield_w = "0.02 gauss"\nfield_u = "-0.47 gauss"\n'
    rng = np.random.default_rng(seed)
    p = draw_truth(rng)
    rows = simulate(p, truth, effect, rng, LAWS, habit)
    study, recording = folder / f"{name}.toml", folder / f"{name}.csv"
    study.write_text(study_text(nominal, LAWS, field))
    with recording.open("w") as out:
        out.write("time [s],position,phase,acc_x [g],acc_y [g],acc_z [g],gimbal_outer [deg],gimbal_middle [deg],"
                  "gimbal_inner [deg],cmd_x [deg/h],cmd_y [deg/h],cmd_z [deg/h],temperature [degC]" +
                  (",oil [smoots]" if unknown else "") + "\n")
        for row in rows:
            more = [math.sin(row[0] / 5000)] if unknown else []
            out.write(",".join(f"{v:.12g}" for v in [*row, *more]) + "\n")
    done = subprocess.run([program, "diagnose", str(study), str(recording), "-o", str(folder / name)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{name}: exit {done.returncode}\n{done.stderr}")
        return False
    answer = json.loads((folder / name / "diagnosis.json").read_text())
    causes = [(c["term"], c["axis"]) for c in answer["causes"]]
    print(f"{name}, rows {habit}: {answer['verdict']} {causes} chi2/dof {answer['fit']['in_sample']['chi2_per_dof_before']:.3f}")
    if cause is not None:
        term, axis, key, value = cause
        good = answer["verdict"] == "named" and [c for c, _ in causes] == [term] and (not axis or causes[0][1] == axis)
        found = [q for c in answer["causes"] for q in c["parameters"] if q["key"] == key]
        for q in found:
            pull = (q["value"] - value) / q["sigma"]
            print(f"  {key} = {q['value']:.5g} +- {q['sigma']:.2g} {q['unit']}, made with {value}: {pull:+.1f} sigma")
            # A dipole's field is not that of the laboratory.
            good = good and abs(q["value"] - value) < 4 * q["sigma"] + (0.15 * abs(value) if dipole else 0)
        return good and bool(found)
    # Nothing hidden: every base parameter against what it was made with.
    subprocess.run([program, "identify", str(study), str(recording), "-o", str(folder / f"{name}_fit")],
                   capture_output=True, text=True, check=True)
    fit = json.loads((folder / f"{name}_fit" / "identification.json").read_text())["filters"][0]["starts"][0]["batch"]["parameters"]
    pulls = {key: (q["estimate"] - p[key]) / q["sigma"] for key, q in fit.items()}
    rms = math.sqrt(sum(v * v for v in pulls.values()) / len(pulls))
    worst = max(pulls, key=lambda k: abs(pulls[k]))
    print(f"  {len(pulls)} base parameters: rms of error/sigma {rms:.2f}, largest {pulls[worst]:+.1f} ({worst})")
    return answer["verdict"] == "consistent" and rms < 1.4 and abs(pulls[worst]) < 4.5


def main():
    program, names = sys.argv[1], sys.argv[2:] or list(CASES)
    with tempfile.TemporaryDirectory() as scratch:
        results = {name: run_case(program, name, Path(scratch)) for name in names}
    wrong = [name for name, good in results.items() if not good]
    print(f"{len(results) - len(wrong)} of {len(results)} as made" + (f"; not: {', '.join(wrong)}" if wrong else ""))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
