#!/usr/bin/env python3
"""A strapdown unit estimated a second time: independent_strapdown.py DRIFTSCOPE RECORDING

One linear regression in numpy, from the definition of the errors alone, of everything that 19 rests of the
recording of the PSINS toolbox show (analysis/docs/real_recording.md): the attitude is carried from the raw
readings, corrected by the errors found so far, and what gravity then lacks at each rest is explained by drift,
scale, tilts and the accelerometers' errors. What `identify` says of gyro tilts and drift must be the same
within one sigma, and what both say of the truth must be such as noise makes it: the chi-square of all 24
estimates together, correlations included. Skipped (77) where the recording is absent.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ARCSEC, DEG_H, G = np.pi / 648000.0, np.pi / 648000.0, 9.79648
LATITUDE, EARTH = np.radians(34.0), 7.2921151467e-5
STEP = 0.01  # [s]
WALK = (0.001 * np.pi / 180.0 / 60.0) ** 2  # of the attitude [rad^2/s]
ACC = 10e-6 * G  # noise density of the accelerometers [m/s^2/sqrt(Hz)]
HIGHEST_CHI2 = 51.2  # 24 numbers that are right exceed it once in a thousand


def cross(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def turn(v):
    angle = np.linalg.norm(v)
    if angle < 1e-9:
        return np.eye(3) + cross(v)
    K = cross(v / angle)
    return np.eye(3) + np.sin(angle) * K + (1.0 - np.cos(angle)) * (K @ K)


def up(t):
    """In the axes East, North, Up of the beginning, inertially at rest."""
    return turn(EARTH * t * np.array([0.0, np.cos(LATITUDE), np.sin(LATITUDE)])) @ np.array([0.0, 0.0, 1.0])


def rests(gyro):
    """Stretches of rows that stand still, their ends left out."""
    still = np.convolve(np.linalg.norm(gyro, axis=1), np.ones(50) / 50, "same") < 2e-4
    ends = [*np.flatnonzero(np.diff(still.astype(int))), len(still) - 1]
    begins = [0, *(e + 1 for e in ends[:-1])]
    return [(b + 60 if b else 0, e - 60) for b, e in zip(begins, ends) if still[(b + e) // 2] and e - b > 300]


# What is estimated: reading = value + E value (+ K2 value^2) + bias, of both; the accelerometers' tilts are
# counted from x, and y within the plane of x and y.
NAMES = ["p0", "p1", "p2"] + [f"E{i}{j}" for i in "xyz" for j in "xyz"] + ["D_x", "D_y", "D_z"] + \
        ["K0_x", "K0_y", "K0_z"] + [f"A{i}{j}" for i in "xyz" for j in "xyz"] + ["K2_x", "K2_y", "K2_z"]
FREE = [k for k, n in enumerate(NAMES) if n not in ("Axy", "Axz", "Ayz")]
GYRO_E, GYRO_D, BIAS, ACC_A, SQUARE = slice(3, 12), slice(12, 15), slice(15, 18), slice(18, 27), slice(27, 30)


def regression(t, gyro, acc, still, x, start):
    """One step about x: sizes of NAMES that are to be added, and their covariance."""
    rate = (gyro - x[GYRO_D]) @ np.linalg.inv(np.eye(3) + x[GYRO_E].reshape(3, 3)).T
    force = acc.copy()
    for _ in range(3):
        force = (acc - x[BIAS] - x[SQUARE] * force ** 2) @ np.linalg.inv(np.eye(3) + x[ACC_A].reshape(3, 3)).T
    C = np.empty((len(t), 3, 3))
    at = turn(x[:3]) @ start
    for k, w in enumerate(rate):
        C[k] = at = at @ turn(w * STEP)
    by_gyro = np.empty((len(t), 3, 12))  # attitude by a reading that is too large
    for i in range(3):
        for j in range(3):
            by_gyro[:, :, 3 * i + j] = -np.cumsum(C[:, :, i] * rate[:, [j]] * STEP, axis=0)
        by_gyro[:, :, 9 + i] = -np.cumsum(C[:, :, i] * STEP, axis=0)
    A, lacking, middles, noise = [], [], [], []
    for begin, end in still:
        rows = range(begin, end, 10)
        a, expected = np.zeros((3, len(NAMES))), np.zeros(3)
        for k in rows:
            u = up(t[k])
            tilt = G * C[k].T @ cross(u) / len(rows)
            a[:, :3] += tilt
            a[:, 3:15] += tilt @ by_gyro[k]
            expected += G * C[k].T @ u / len(rows)
        mean = force[begin:end].mean(axis=0)
        a[:, BIAS] = np.eye(3)
        for i in range(3):
            a[i, 18 + 3 * i:21 + 3 * i] = mean
            a[i, 27 + i] = mean[i] ** 2
        A.append(a)
        lacking.append(mean - expected)
        middles.append(((begin + end) // 2, tilt * len(rows)))
        noise += [ACC ** 2 / ((end - begin) * STEP)] * 3
    R = np.diag(noise)
    for i, (m, tilt_m) in enumerate(middles):
        for j, (n, tilt_n) in enumerate(middles):
            R[3 * i:3 * i + 3, 3 * j:3 * j + 3] += WALK * min(t[m], t[n]) * tilt_m @ tilt_n.T
    A, lacking, weight = np.vstack(A)[:, FREE], np.hstack(lacking), np.linalg.inv(R)
    P = np.linalg.inv(A.T @ weight @ A)
    step = P @ A.T @ weight @ lacking
    left = lacking - A @ step
    return step, P, left @ weight @ left / (len(left) - len(step))


def estimate(path):
    data = np.loadtxt(path, delimiter=",", skiprows=2)
    t, gyro, acc = data[:, 0], data[:, 1:4], data[:, 4:7]
    still = rests(gyro)
    assert len(still) == 19, len(still)
    first = slice(*still[0])
    z = acc[first].mean(axis=0) / np.linalg.norm(acc[first].mean(axis=0))
    north = gyro[first].mean(axis=0)
    north -= north @ z * z
    north /= np.linalg.norm(north)
    start = np.array([np.cross(north, z), north, z])
    x = np.zeros(len(NAMES))
    for _ in range(3):
        step, P, chi2 = regression(t, gyro, acc, still, x, start)
        # A step of the attitude turns what stands: small, so that rotation vectors add up.
        x[FREE] += step
    assert np.max(np.abs(step[3:]) / np.sqrt(np.diag(P))[3:]) < 0.05, "not converged"
    return x, P, chi2


TRUTH = {"Exx": -10e-6, "Eyy": -20e-6, "Ezz": -30e-6, "Exy": 10 * ARCSEC, "Exz": 20 * ARCSEC, "Eyx": 30 * ARCSEC,
         "Eyz": 40 * ARCSEC, "Ezx": 50 * ARCSEC, "Ezy": 60 * ARCSEC, "D_x": -0.1 * DEG_H, "D_y": -0.2 * DEG_H,
         "D_z": -0.3 * DEG_H, "K0_x": -10e-6 * G, "K0_y": -20e-6 * G, "K0_z": -30e-6 * G, "Axx": -10e-6, "Ayy": -20e-6,
         "Azz": -30e-6, "Ayx": 10 * ARCSEC, "Azx": 20 * ARCSEC, "Azy": 30 * ARCSEC, "K2_x": -10e-6 / G,
         "K2_y": -20e-6 / G, "K2_z": -30e-6 / G}
# The same numbers of `identify`, and their units.
SAME = {"xi_x": ("Exy", ARCSEC), "eta_x": ("Exz", ARCSEC), "eta_y": ("Eyx", ARCSEC), "xi_y": ("Eyz", ARCSEC),
        "xi_z": ("Ezx", ARCSEC), "eta_z": ("Ezy", ARCSEC), "D_F_x": ("D_x", DEG_H), "D_F_y": ("D_y", DEG_H),
        "D_F_z": ("D_z", DEG_H), "s_x": ("Exx", 1e-6), "s_y": ("Eyy", 1e-6), "s_z": ("Ezz", 1e-6)}


def main():
    program, recording = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    if not recording.exists():
        print(f"skipped: {recording.name} is no part of the repository")
        sys.exit(77)
    x, P, chi2 = estimate(recording)
    study = pathlib.Path(__file__).resolve().parents[1] / "configs/strapdown_psins.toml"
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([program, "identify", study, recording.resolve(), "-o", "out", "--progress", "none"], cwd=scratch,
                       check=True, stdout=subprocess.DEVNULL)
        answer = json.loads((pathlib.Path(scratch) / "out/identification.json").read_text())
    theirs = {p["key"]: p for p in answer["filters"][0]["parameters"]}
    names = [NAMES[k] for k in FREE]
    worst = 0.0
    for key, (name, unit) in SAME.items():
        own, sigma = x[NAMES.index(name)] / unit, np.sqrt(P[names.index(name), names.index(name)]) / unit
        apart = abs(theirs[key]["value"] - own) / sigma
        worst = max(worst, apart)
        print(f"{key:6} {own:9.3f} +- {sigma:.3f}, identify {theirs[key]['value']:9.3f}: {apart:.2f} sigma apart")
    known = [k for k, n in enumerate(names) if n in TRUTH]
    off = np.array([x[FREE[k]] - TRUTH[names[k]] for k in known])
    joint = off @ np.linalg.solve(P[np.ix_(known, known)], off)
    pulls = off / np.sqrt(np.diag(P)[known])
    largest = int(np.argmax(np.abs(pulls)))
    print(f"largest distance of one estimate to the truth {pulls[largest]:.1f} sigma ({names[known[largest]]}); of all "
          f"{len(known)} together chi-square {joint:.1f}; of what is left per degree of freedom {chi2:.2f}")
    assert worst < 1.0, "the two implementations differ"
    assert joint < HIGHEST_CHI2, "the estimates are further from the truth than noise takes them"


if __name__ == "__main__":
    main()
